// `fencepost doctor` and `replay --diff` as their users call them.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/hal/linux/pty.hpp"
#include "tests/host/cli/run.hpp"
#include "tests/host/doctor/drive.hpp"

namespace fencepost::host {
namespace {

using namespace testing;

TEST(DoctorCommand, FindsNothingInAGoodLog) {
  const Outcome run = shell("fencepost doctor " + recording("stop_pixy2.log"));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(run.out.ends_with("\nnothing is wrong with it\n")) << run.out;
}

TEST(DoctorCommand, EndsWithOneWhereALogHasAFault) {
  spill("bad.log", Drive{.camera = ""}.stream());
  const Outcome run = shell("fencepost doctor bad.log");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_TRUE(holds(run.out, "FAULT    no FPCAM: nothing says how the camera sees; replay takes one with --camera"));
}

TEST(DoctorCommand, ComparesWithAGoodDay) {
  spill("good.log", Drive().stream());
  spill("today.log", Drive{.seen = [](int i) { return i % 15 != 0; }}.stream());
  EXPECT_EQ(shell("fencepost doctor good.log --compare good.log").exit_code, 0);
  const Outcome run = shell("fencepost doctor today.log --compare good.log");
  EXPECT_EQ(run.exit_code, 1) << run.out;
  EXPECT_TRUE(holds(run.out, "red: flicker, of 100 frames"));
  const auto document = nlohmann::json::parse(shell("fencepost doctor today.log --compare good.log --json").out);
  EXPECT_EQ(document["worse"].size(), 1U);
  EXPECT_EQ(document["findings"].size(), 0U);
  EXPECT_EQ(document["survey"]["colours"].size(), 1U);
}

TEST(DoctorCommand, ListsPortsWithoutOpeningThem) {
  const Outcome run = shell("fencepost doctor --json");
  EXPECT_TRUE(run.exit_code == 0 || run.exit_code == 4) << run.err;
  const auto document = nlohmann::json::parse(run.out);
  EXPECT_TRUE(document["ports"].is_array());
  EXPECT_EQ(document["ports"].empty(),
            document["findings"].size() == 1 && document["findings"][0]["code"] == "no_port");
}

TEST(DoctorCommand, SaysHowADeviceIs) {
  const Outcome missing = shell("fencepost doctor --camera pixy2:./none");
  EXPECT_EQ(missing.exit_code, 4);
  EXPECT_TRUE(holds(missing.out, "FAULT    ./none is not there; plug it in"));
  const Outcome port = shell("fencepost doctor /dev/ttyNone9");
  EXPECT_EQ(port.exit_code, 4);
  EXPECT_TRUE(holds(port.out, "/dev/ttyNone9 is not there"));
}

TEST(DoctorCommand, TellsWhoMayNotOpenAPortWhatToType) {
  if (::geteuid() != 0 || !testing::anybody_can_run()) GTEST_SKIP() << "needs root, to become somebody else";
  const linux::FarEnd far((folder() / "tty").string());
  const Outcome run = shell(testing::as_anybody() + "fencepost doctor --camera pixy2:./tty");
  EXPECT_EQ(run.exit_code, 4);
  EXPECT_TRUE(holds(run.out, "may not open it; type 'sudo "));
}

TEST(DoctorCommand, RefusesWhatMakesNoSense) {
  spill("a.log", Drive().stream());
  for (const char* line : {"fencepost doctor --compare a.log", "fencepost doctor a.log --camera pixy2:./x",
                           "fencepost doctor --camera console", "fencepost doctor --camera nxtcam:nxt",
                           "fencepost doctor - --compare -"}) {
    const Outcome run = shell(line);
    EXPECT_EQ(run.exit_code, 2) << line << run.err;
    EXPECT_EQ(run.out, "") << line;
  }
  EXPECT_EQ(shell("fencepost doctor missing.log").exit_code, 3);
}

TEST(ReplayDiffCommand, ShowsBothLogs) {
  const std::string log = recording("approach_stop.log");
  EXPECT_EQ(shell("fencepost replay --diff " + log + " " + log).exit_code, 0);
  const Outcome run = shell("fencepost replay --diff " + log + " " + recording("stop_pixy2.log"));
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_TRUE(holds(run.out, "calibration: \n  camera fx"));
  EXPECT_EQ(shell("fencepost replay --diff " + log).exit_code, 2);
  EXPECT_EQ(shell("fencepost replay x --diff " + log + " " + log).exit_code, 2);
  EXPECT_EQ(shell("fencepost replay --diff " + log + " missing.log").exit_code, 3);
}

// No frame comes before white balance and gain have settled: that is no fault.
TEST(DoctorCommand, WaitsForACameraThatSettles) {
  const std::string scene = recording("stop_cmucam2.json");
  const Outcome run =
      shell("fencepost emulate cmucam2 " + scene + " --link cam > emulated 2>&1 & " +
            "until [ -e cam ]; do sleep 0.05; done; " + "fencepost doctor --camera cmucam2:./cam,settle=4 --robot " +
            scene + "; code=$?; kill $!; wait; exit $code");
  EXPECT_EQ(run.exit_code, 0) << run.out << run.err;
  EXPECT_TRUE(holds(run.out, "cmucam2 at ./cam works"));
}

}  // namespace
}  // namespace fencepost::host
