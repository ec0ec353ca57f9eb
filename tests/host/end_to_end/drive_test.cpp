// Every camera and every wheel base, emulated in one process and read by the robot's loop in another.
#include <gtest/gtest.h>

#include <csignal>

#include "host/devices/catalogue.hpp"
#include "tests/host/end_to_end/drive_scene.hpp"

namespace fencepost::host::testing {
namespace {

struct Drive {
  std::string name;
  std::vector<std::string> emulated;  ///< in the order of their links
  std::string camera;                 ///< as given to `run`
  std::string odometry;
  double odometry_error = 0.01;  ///< share of the way
  double speed = 0.3;            ///< m/s
  bool boxes = true;             ///< the camera tells them; else what is tall seems wide, and so nearer
  friend void PrintTo(const Drive& drive, std::ostream* out) { *out << drive.name; }
};

struct Wheels {
  std::string name;
  double error;
};

/// Every camera of the catalogue that can be emulated, each with the next one of the wheel bases.
std::vector<Drive> drives() {
  const Wheels wheels[] = {{"create2", 0.01}, {"records", 0.01}, {"nxt", 0.02}, {"create1", 0.01}};
  std::vector<Drive> drives;
  for (const devices::Row* row : devices::rows_for(devices::Use::kCamera)) {
    if (!row->emulated->has_value()) continue;
    std::string name = *row->name;
    std::erase(name, '.');
    const Wheels& base = wheels[drives.size() % std::size(wheels)];
    const auto& options = devices::options_of(*row, devices::Use::kCamera);
    const bool settles = std::any_of(options.begin(), options.end(), [](const auto& o) { return *o.name == "settle"; });
    drives.push_back({name + "_" + base.name,
                      {*row->name, base.name},
                      *row->name + ":./a" + (settles ? ",settle=0" : ""),
                      base.name + ":./b",
                      base.error,
                      0.3,
                      *row->name != "cognachrome"});
  }
  drives.push_back({"nxtcam_behind_the_brick", {"nxtcam:nxt"}, "nxtcam:nxt", "nxt:./a", 0.02});
  return drives;
}

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
  expect_things(folder, camera_of(GetParam().camera), GetParam().odometry_error, GetParam().boxes);
  EXPECT_NE(out.find("WARN    red"), std::string::npos) << out;
  EXPECT_NE(out.find("STOP    red"), std::string::npos) << out;
  EXPECT_TRUE(!GetParam().boxes || out.find("STOP    yellow") == std::string::npos) << out;
  EXPECT_EQ(emulated.find("nothing sensible gets through"), std::string::npos) << "both have the same baud rate";
  EXPECT_EQ(emulated.find("bytes are lost"), std::string::npos) << emulated;
}

INSTANTIATE_TEST_SUITE_P(All, EndToEnd, ::testing::ValuesIn(drives()),
                         [](const auto& drive) { return drive.param.name; });

using EndToEndFaults = EndToEnd;

// One byte in 100 is lost and one is damaged; and the camera's plug is out for half a second.
TEST_F(EndToEndFaults, ARunSurvivesABadCable) {
  const std::vector<Drive> all = drives();
  const auto pixy2 =
      std::find_if(all.begin(), all.end(), [](const Drive& each) { return each.emulated[0] == "pixy2"; });
  ASSERT_NO_FATAL_FAILURE(drive(*pixy2, {"--fault", "drop=0.01,corrupt=0.01", "--fault", "pixy2:unplug=4:0.5"}));
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
