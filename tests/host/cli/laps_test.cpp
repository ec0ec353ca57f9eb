// The bundled arena of WRO Future Engineers as its users drive it: three laps, and what was passed on which side.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/host/cli/run.hpp"

namespace fencepost::host::cli {
namespace {

using namespace testing;

constexpr const char* kSides = "--sides red=right,green=left";

/// Three laps past seven pillars; the log is laps.log.
struct Laps : ::testing::Test {
  Folder folder;
  void SetUp() override {
    auto scene = nlohmann::json::parse(slurp(FENCEPOST_RECORDINGS "/wro_lap.json"));
    scene["path"]["laps"] = 3;
    spill(folder.path() / "laps.json", scene.dump());
    const Outcome run = shell(folder, "fencepost simulate laps.json -o laps.log");
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }
};

TEST_F(Laps, EachPillarIsPassedOnItsSideInEachLap) {
  const Outcome run = shell(folder, std::string("fencepost replay laps.log --json ") + kSides);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  ASSERT_EQ(json["passes"].size(), 21U);
  const std::array<int, 7> colours = {1, 2, 1, 2, 1, 2, 1};  // red, green
  for (std::size_t i = 0; i < json["passes"].size(); ++i) {
    const auto& pass = json["passes"][i];
    SCOPED_TRACE(pass.dump());
    EXPECT_EQ(pass["signature"], colours[i % colours.size()]);
    EXPECT_EQ(pass["side"], pass["signature"] == 1 ? "right" : "left");
    EXPECT_LT(pass["known"]["t"].get<double>(), pass["t"].get<double>());
    EXPECT_LT(std::fabs(pass["known"]["bearing"].get<double>()), 2);
    EXPECT_GT(pass["known"]["distance"].get<double>(), 0.2);
  }
  EXPECT_NE(shell(folder, std::string("fencepost replay laps.log ") + kSides).out.find("passed at"), std::string::npos);
}

TEST_F(Laps, TheWrongSideIsSaid) {
  EXPECT_NE(shell(folder, "fencepost replay laps.log --sides red=left,green=left").exit_code, 0);
}

TEST_F(Laps, TheLogSaysHowWideThePillarsAre) {
  EXPECT_NE(slurp(folder.path() / "laps.log").find("$FPSIG,1,ee2737,red,0.064*"), std::string::npos);
  const auto json = nlohmann::json::parse(shell(folder, "fencepost replay laps.log --json").out);
  EXPECT_EQ(json["signatures"][0]["size"], 0.064);
}

}  // namespace
}  // namespace fencepost::host::cli
