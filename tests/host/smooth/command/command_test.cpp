// `fencepost smooth` and `evaluate --smooth` as their users run them.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "host/scene/load.hpp"
#include "tests/host/cli/run.hpp"
#include "tests/host/smooth/round_trip.hpp"

namespace fencepost::host {
namespace {

using namespace testing;

test::RoundTrip drifting() {
  test::RoundTripOptions options;
  options.seed = 371;
  options.drift = 0.03;
  return test::round_trip(options);
}

TEST(SmoothCommand, WritesTextJsonAndAReport) {
  spill("run.log", drifting().log);
  const Outcome run =
      shell("fencepost smooth run.log --report run.html && fencepost smooth run.log --json -o run.json");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(holds(run.out, "online against optimum"));
  EXPECT_NE(slurp("run.html").find("show-online"), std::string::npos);
  const nlohmann::json result = nlohmann::json::parse(slurp("run.json"));
  EXPECT_EQ(result.at("objects").size(), 6U);
  EXPECT_TRUE(result.at("objects")[0].at("models").contains("optimum"));
  EXPECT_GT(result.at("path").size(), 100U);
  EXPECT_LE(result.at("path").size(), 2000U);
  EXPECT_GT(result.at("par").at("map_rms"), 0.01);
}

TEST(SmoothCommand, EvaluatePrintsOnlineAgainstOptimum) {
  const test::RoundTrip trip = drifting();
  spill("run.log", trip.log);
  spill("run.json", write_scene(trip.scene));
  const Outcome text = shell("fencepost evaluate run.log --smooth");
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_TRUE(holds(text.out, "Online against optimum"));
  const Outcome json = shell("fencepost evaluate run.log --smooth --json");
  const nlohmann::json smooth = nlohmann::json::parse(json.out).at("smooth");
  ASSERT_EQ(smooth.size(), 1U);
  EXPECT_LT(smooth[0].at("optimum").at("aligned"), smooth[0].at("online").at("aligned"));
  const Outcome without = shell("fencepost evaluate run.log --json");
  EXPECT_FALSE(nlohmann::json::parse(without.out).contains("smooth"));
}

TEST(SmoothCommand, TakesACarsLog) {
  const Outcome run = shell("fencepost smooth " FENCEPOST_SOURCE_DIR "/host/share/recordings/wro_lap.log --json");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json result = nlohmann::json::parse(run.out);
  EXPECT_EQ(result.at("objects").size(), 7U);
  EXPECT_LT(result.at("par").at("map_rms"), 0.02);
}

struct Refused {
  const char* line;
  int status;
  const char* says;
};

class SmoothRefuses : public ::testing::TestWithParam<Refused> {};

TEST_P(SmoothRefuses, WithAReasonOnStandardErrorOnly) {
  const std::string log = drifting().log;
  spill("run.log", log);
  spill("empty.log", "");
  const Outcome run = shell(std::string("grep -v FPODO run.log >still.log; ") + GetParam().line);
  EXPECT_EQ(run.exit_code, GetParam().status) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_TRUE(holds(run.err, GetParam().says));
}

INSTANTIATE_TEST_SUITE_P(All, SmoothRefuses,
                         ::testing::Values(Refused{"fencepost smooth empty.log", 3, "empty"},
                                           Refused{"fencepost smooth nowhere.log", 3, "nowhere.log"},
                                           Refused{"fencepost smooth still.log", 3, "no odometry ($FPODO)"},
                                           Refused{"fencepost smooth run.log --from 3 --to 1", 2, "swap them"},
                                           Refused{"fencepost smooth run.log --report -", 2, "standard output"},
                                           Refused{"fencepost evaluate - --scene run.log --smooth <run.log", 2,
                                                   "put standard input into a file"}));

}  // namespace
}  // namespace fencepost::host
