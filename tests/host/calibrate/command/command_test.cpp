// `fencepost calibrate` as its users run it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/firmware/record/lines.hpp"
#include "tests/host/cli/run.hpp"
#include "tests/studies/calibrate/faulty_drive.hpp"

namespace fencepost::host {
namespace {

using namespace testing;

std::string drive(test::Motion motion = test::Motion::kGuide, int blocks = 4) {
  test::DriveOptions options;
  options.seed = 510;
  options.motion = motion;
  options.blocks = blocks;
  return test::calibration_drive(options).log;
}

TEST(CalibrateCommand, WritesATableTheLineTheRobotFileAndAPicture) {
  spill("run.log", drive());
  spill("robot.json", R"({"robot": {"width": 0.3}, "wheels": {"track": 0.2}})");
  const Outcome run = shell(
      "fencepost calibrate run.log --robot robot.json --write-robot new.json --write-camera "
      "camera.txt --picture calibration.svg && fencepost replay run.log --camera camera.txt "
      "-o replayed.txt && fencepost calibrate run.log --json -o run.json");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const std::string line = slurp("camera.txt");
  EXPECT_TRUE(line.starts_with("$FPCAM,pixy2,316,208,")) << line;
  EXPECT_TRUE(holds(run.out, "focal length"));
  EXPECT_TRUE(holds(run.out, line));
  const nlohmann::json robot = nlohmann::json::parse(slurp("new.json"));
  EXPECT_EQ(robot.at("robot").at("width"), 0.3);
  EXPECT_TRUE(robot.at("camera").at("mount").contains("yaw"));
  EXPECT_NE(slurp("calibration.svg").find("</svg>"), std::string::npos);
  const nlohmann::json result = nlohmann::json::parse(slurp("run.json"));
  EXPECT_TRUE(result.at("complete"));
  EXPECT_GT(result.at("parameters").at("yaw").at("sigma"), 0);
  EXPECT_EQ(result.at("fpcam").get<std::string>() + "\r\n", line);
}

std::string padded_drive(double pad) {
  test::DriveOptions options;
  options.seed = 510;
  options.pad = pad;
  return test::calibration_drive(options).log;
}

TEST(CalibrateCommand, FindsWhatBoxesAreTooWideAndWritesIt) {
  spill("run.log", padded_drive(4));
  const Outcome run = shell(
      "fencepost calibrate run.log --write-robot new.json && "
      "fencepost calibrate run.log --json -o run.json");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json result = nlohmann::json::parse(slurp("run.json"));
  ASSERT_EQ(result.at("pads").size(), 4U) << "four colours of one block each share it";
  for (const nlohmann::json& pad : result.at("pads")) {
    const double sigma = pad.at("sigma");
    EXPECT_LT(sigma, 0.5);
    EXPECT_NEAR(pad.at("found").get<double>(), 4, 2 * sigma);
    EXPECT_EQ(pad.at("configured"), 0);
  }
  EXPECT_TRUE(holds(run.out, "pad of red"));
  const std::string line = result.at("fpsig").at(0);
  EXPECT_TRUE(line.starts_with("$FPSIG,1,d02020,red,,")) << line;
  EXPECT_TRUE(holds(run.out, line));
  const nlohmann::json robot = nlohmann::json::parse(slurp("new.json"));
  EXPECT_EQ(robot.at("signatures").at(0).at("pad"), 4);
}

// Four red pillars and three green ones.
TEST(CalibrateCommand, AColourOfFewThingsSharesItsPadWithAllOthers) {
  nlohmann::json scene = nlohmann::json::parse(slurp(FENCEPOST_SOURCE_DIR "/host/share/recordings/wro_lap.json"));
  scene.at("noise")["edge_bias_px"] = 5;
  spill("scene.json", scene.dump());
  const Outcome run = shell("fencepost simulate scene.json -o run.log && fencepost calibrate run.log --json");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json result = nlohmann::json::parse(run.out);
  ASSERT_EQ(result.at("pads").size(), 2U);
  for (const nlohmann::json& pad : result.at("pads")) EXPECT_NEAR(pad.at("found").get<double>(), 5, 0.5);
  EXPECT_NEAR(result.at("parameters").at("pitch").at("found").get<double>(), 0, 0.2);
}

// The log's robot takes off twice what it should. The pad that is found is the whole one.
TEST(CalibrateCommand, GoesOnFromThePadsOfTheLog) {
  std::string log = padded_drive(4);
  std::string padded;
  while (!log.empty()) {
    const std::string line = log.substr(0, log.find('\n') + 1);
    log.erase(0, line.size());
    padded += line.starts_with("$FPSIG") ? record::sealed(line.substr(1, line.find('*') - 1) + ",,8") + "\r\n" : line;
  }
  spill("run.log", padded);
  const Outcome run = shell("fencepost calibrate run.log --json");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json result = nlohmann::json::parse(run.out);
  ASSERT_EQ(result.at("pads").size(), 4U);
  EXPECT_EQ(result.at("pads").at(0).at("configured"), 8);
  EXPECT_NEAR(result.at("pads").at(0).at("found").get<double>(), 4, 1);
}

TEST(CalibrateCommand, SaysNothingOfBoxesThatAreRight) {
  spill("run.log", drive());
  const Outcome run = shell("fencepost calibrate run.log --json");
  EXPECT_EQ(nlohmann::json::parse(run.out).at("pads").size(), 0U) << run.out;
}

using Codes = std::vector<std::string>;

/// The codes by which `doctor` judges a log's distances.
Codes doctor_says(const std::string& log) {
  const Outcome run = shell("fencepost doctor " + log + " --json");
  Codes codes;
  const nlohmann::json document = nlohmann::json::parse(run.out);
  for (const auto& finding : document.at("findings")) {
    const std::string code = finding.at("code");
    if (code.starts_with("distance_")) codes.push_back(code);
  }
  return codes;
}

Codes doctor_says(test::Fault fault) {
  const Folder folder;
  test::DriveOptions options;
  options.seed = 42'003;
  spill("run.log", test::faulty_drive(options, fault, false));
  return doctor_says("run.log");
}

TEST(DistancesByDoctor, EachFaultIsNamedAndNoOther) {
  EXPECT_EQ(doctor_says(test::Fault::kNone), Codes{});
  EXPECT_EQ(doctor_says(test::Fault::kPadAll), Codes{"distance_pad"});
  EXPECT_EQ(doctor_says(test::Fault::kPadOne), Codes{});
  EXPECT_EQ(doctor_says(test::Fault::kTilt), Codes{"distance_pitch"});
  EXPECT_EQ(doctor_says(test::Fault::kTurns), Codes{"distance_turns"});
}

TEST(DistancesByDoctor, APadIsGivenAsTheLinesThatMendIt) {
  test::DriveOptions options;
  options.seed = 42'003;
  spill("run.log", test::faulty_drive(options, test::Fault::kPadAll, false));
  const Outcome run = shell("fencepost doctor run.log");
  EXPECT_TRUE(holds(run.out, "$FPSIG,1,d02020,red,,"));
  EXPECT_TRUE(holds(run.out, "$FPSIG,4,"));
}

/// A camera that looks at the centre of its circle: no wheels roll like that.
TEST(DistancesByDoctor, NothingIsJudgedOfARobotThatMovesSideways) {
  EXPECT_EQ(doctor_says(recording("noisy_arc.log")), Codes{});
  const Outcome run = shell("fencepost doctor " + recording("noisy_arc.log"));
  EXPECT_TRUE(holds(run.err, "moves sideways"));
}

TEST(CalibrateCommand, WhatALogCannotTellIsNamedAndIsStatusOne) {
  spill("run.log", drive(test::Motion::kSpin));
  const Outcome run = shell("fencepost calibrate run.log");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_TRUE(holds(run.err, "yaw is not found from this log"));
  EXPECT_TRUE(holds(run.out, "not found"));
}

// A car's readings become poses as they do on the robot.
TEST(CalibrateCommand, TakesACarsLog) {
  const std::string log = FENCEPOST_SOURCE_DIR "/host/share/recordings/wro_lap.log";
  const Outcome run = shell("fencepost calibrate " + log + " --json");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json found = nlohmann::json::parse(run.out);
  EXPECT_NEAR(found.at("parameters").at("yaw").at("found").get<double>(), 0, 0.3);
  EXPECT_NEAR(found.at("parameters").at("focal_length").at("found").get<double>(), 188, 3);
}

struct Refused {
  const char* line;
  int status;
  const char* says;
};

class CalibrateRefuses : public ::testing::TestWithParam<Refused> {};

TEST_P(CalibrateRefuses, WithAReasonOnStandardErrorOnly) {
  spill("run.log", drive());
  spill("standing.log", drive(test::Motion::kStanding));
  spill("one.log", drive(test::Motion::kGuide, 1));
  spill("empty.log", "");
  const Outcome run = shell(GetParam().line);
  EXPECT_EQ(run.exit_code, GetParam().status) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_TRUE(holds(run.err, GetParam().says));
}

INSTANTIATE_TEST_SUITE_P(
    All, CalibrateRefuses,
    ::testing::Values(Refused{"fencepost calibrate empty.log", 3, "empty"},
                      Refused{"fencepost calibrate nowhere.log", 3, "nowhere.log"},
                      Refused{"fencepost calibrate standing.log", 3, "hardly moves"},
                      Refused{"fencepost calibrate one.log", 3, "at least 2"},
                      Refused{"fencepost calibrate run.log --from 1 --to 1.4", 3, "drive some 20 s"},
                      Refused{"fencepost calibrate run.log --size red", 2, "NAME=DIAMETER"},
                      Refused{"fencepost calibrate run.log --size red=nan", 2, "no length"},
                      Refused{"fencepost calibrate run.log --size purple=0.05", 2, "no colour \"purple\""},
                      Refused{"fencepost calibrate run.log --distance red=0.5", 2, "NAME,NAME=METRES"},
                      Refused{"fencepost calibrate run.log --from 3 --to 1", 2, "swap them"},
                      Refused{"fencepost calibrate run.log --json --picture -", 2, "standard output"}));

}  // namespace
}  // namespace fencepost::host
