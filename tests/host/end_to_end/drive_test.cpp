// Every camera and every wheel base, emulated in one process and read by the robot's loop in another.
#include <gtest/gtest.h>

#include <csignal>

#include "tests/host/end_to_end/stage.hpp"

namespace fencepost::host::testing {
namespace {

struct Drive {
  const char* name;
  std::vector<std::string> emulated;  ///< in the order of their links
  std::string camera;                 ///< as given to `run`
  std::string odometry;
  double odometry_error;  ///< share of the way
  double speed = 0.3;     ///< m/s
  friend void PrintTo(const Drive& drive, std::ostream* out) { *out << drive.name; }
};

const Drive kDrives[] = {
    {"Pixy2OnACreate2", {"pixy2", "create2"}, "pixy2:./a", "create2:./b", 0.01},
    {"Pixy21", {"pixy2.1", "create2"}, "pixy2.1:./a", "create2:./b", 0.01},
    {"CmuCam1", {"cmucam1", "records"}, "cmucam1:./a,settle=0", "records:./b", 0.01},
    {"CmuCam2", {"cmucam2", "create2"}, "cmucam2:./a,settle=0", "create2:./b", 0.01},
    {"CmuCam3", {"cmucam3", "records"}, "cmucam3:./a,settle=0", "records:./b", 0.01},
    {"CmuCam4", {"cmucam4", "create2"}, "cmucam4:./a,settle=0", "create2:./b", 0.01},
    {"NxtCamOnItsSerialLine", {"nxtcam", "records"}, "nxtcam:./a", "records:./b", 0.01},
    {"NxtCamBehindTheBrick", {"nxtcam:nxt"}, "nxtcam:nxt", "nxt:./a", 0.02},
    {"NxtCam5", {"nxtcam5", "create2"}, "nxtcam5:./a", "create2:./b", 0.01},
    {"AvrCam", {"avrcam", "nxt"}, "avrcam:./a", "nxt:./b", 0.02},
    {"Xbc", {"xbc", "create2"}, "xbc:./a", "create2:./b", 0.01},
};

std::vector<std::string> emulation(const Drive& drive, const std::vector<std::string>& more = {}) {
  std::vector<std::string> words = {"emulate"};
  words.insert(words.end(), drive.emulated.begin(), drive.emulated.end());
  words.emplace_back("scene.json");
  for (std::size_t i = 0; i < drive.emulated.size(); ++i) {
    words.emplace_back("--link");
    words.emplace_back(i == 0 ? "a" : "b");
  }
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

std::vector<std::string> running(const Drive& drive) {
  return {"run",        "--camera", drive.camera, "--odometry", drive.odometry, "--robot",
          "scene.json", "--log",    "run.log",    "--mode",     "text"};
}

class EndToEnd : public ::testing::TestWithParam<Drive> {
 protected:
  /// Both programs from the first command to the end of the drive; what `run` said is then in its files.
  void drive(const Drive& drive, const std::vector<std::string>& more = {}) {
    spill(folder.path() / "scene.json", scene_for(camera_of(drive.camera), 12, drive.speed));
    Process emulate(folder, emulation(drive, more), "emulate.");
    ASSERT_TRUE(eventually([&] { return std::filesystem::exists(folder.path() / last_link(drive)); })) << emulate.err();
    Process run(folder, running(drive), "run.");
    EXPECT_EQ(emulate.wait(), 0) << emulate.err();
    EXPECT_EQ(run.end(SIGTERM), 0) << run.err();
    out = run.out();
    err = run.err();
    emulated = emulate.err();
  }
  static std::string last_link(const Drive& drive) { return drive.emulated.size() > 1 ? "b" : "a"; }

  Folder folder;
  std::string out;
  std::string err;
  std::string emulated;
};

TEST_P(EndToEnd, ADriveIsSeenWarnedOfLoggedAndReplayed) {
  ASSERT_NO_FATAL_FAILURE(drive(GetParam()));
  expect_replays(folder, err);
  expect_things(folder, camera_of(GetParam().camera), GetParam().odometry_error);
  EXPECT_NE(out.find("WARN    red"), std::string::npos) << out;
  EXPECT_NE(out.find("STOP    red"), std::string::npos) << out;
  EXPECT_EQ(out.find("STOP    yellow"), std::string::npos) << out;
  EXPECT_EQ(emulated.find("a real cable would carry nothing"), std::string::npos) << "both have the same baud rate";
  EXPECT_EQ(emulated.find("bytes are lost"), std::string::npos) << emulated;
}

INSTANTIATE_TEST_SUITE_P(All, EndToEnd, ::testing::ValuesIn(kDrives),
                         [](const auto& drive) { return std::string(drive.param.name); });

using EndToEndFaults = EndToEnd;

// Of 100 bytes one is lost and one is another; and the camera's plug is out for half a second.
TEST_F(EndToEndFaults, ARunSurvivesABadCable) {
  ASSERT_NO_FATAL_FAILURE(drive(kDrives[0], {"--fault", "drop=0.01,corrupt=0.01", "--fault", "pixy2:unplug=4:0.5"}));
  expect_replays(folder, err);
  EXPECT_NE(err.find("camera pixy2 at ./a is absent"), std::string::npos) << err;
  EXPECT_NE(err.find("pixy2 at ./a works\n", err.find("is absent")), std::string::npos) << err;
  const std::string log = slurp(folder.path() / "run.log");
  EXPECT_NE(log.find(",pixy2,absent,./a*"), std::string::npos);
  EXPECT_NE(log.find(",pixy2,ok,./a*"), std::string::npos);
  EXPECT_NE(out.find("  red  "), std::string::npos) << "it is still warned of: " << out;
  std::smatch counts;
  ASSERT_TRUE(std::regex_search(emulated, counts, std::regex("of ([0-9]+) bytes ([0-9]+) dropped, ([0-9]+) corr")))
      << emulated;
  EXPECT_GT(std::stoi(counts[2]), 0);
  EXPECT_GT(std::stoi(counts[3]), 0);
}

}  // namespace
}  // namespace fencepost::host::testing
