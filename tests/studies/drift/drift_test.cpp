// Pose correction in the whole loop: off it changes nothing, on it replays to the bit, and it bears being lied to.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "firmware/record/encode.hpp"
#include "host/replay/replay.hpp"
#include "tests/studies/drift/drift_run.hpp"

namespace fencepost::test {
namespace {

constexpr std::size_t kMiddle = 1;  // of drifts(): 3 %, 2 deg/m
constexpr std::size_t kNone = 3;

DriftOptions options_of(unsigned seed, const char* correct) {
  DriftOptions options;
  options.seed = seed;
  options.drift = drifts()[kMiddle];
  options.correct = correct;
  return options;
}

struct Replayed {
  host::ReplayOutcome outcome;
  std::string log;  ///< that the robot itself wrote
};

Replayed run(const std::string& log, const std::string& profile, bool check = false) {
  Replayed run;
  host::ReplayOptions options;
  options.profile = profile;
  options.check = check;
  options.log = [&](std::string_view line) { run.log += line; };
  run.outcome = host::replay(log, "drift", options);
  return run;
}

std::size_t count_of(const std::string& log, std::string_view what) {
  std::size_t found = 0;
  for (std::size_t at = log.find(what); at != std::string::npos; at = log.find(what, at + 1)) ++found;
  return found;
}

std::string setting(std::string_view key, std::string_view value) {
  std::array<char, record::kMaxLine> line{};
  const std::size_t size = record::encode(record::Setting{key, value}, line);
  return {line.data(), size};
}

class DriftIn : public testing::TestWithParam<const char*> {};

TEST_P(DriftIn, OffThePoseIsTheOdometry) {
  const Replayed off = run(drift_log(options_of(3, "off")), GetParam());
  EXPECT_EQ(count_of(off.log, "$FPPOS"), 0U);
  const auto& result = off.outcome.result;
  ASSERT_TRUE(result.pose.has_value());
  const std::size_t last = off.log.rfind("$FPODO");
  std::array<char, 64> expected{};
  std::snprintf(expected.data(), expected.size(), ",%.4f,%.4f,%.4f*", result.pose->x, result.pose->y,
                result.pose->heading);
  EXPECT_NE(off.log.find(expected.data(), last), std::string::npos) << expected.data() << off.log.substr(last, 60);
}

TEST_P(DriftIn, OnItSaysWhereItIs) {
  const Replayed on = run(drift_log(options_of(3, "on")), GetParam());
  const Replayed off = run(drift_log(options_of(3, "off")), GetParam());
  EXPECT_GE(count_of(on.log, "$FPPOS"), 10U);  // twice a second
  EXPECT_NE(on.outcome.result.digest, off.outcome.result.digest);
  EXPECT_EQ(on.outcome.result.objects.empty(), false);
}

// The log that a correcting robot writes gives the same poses, objects and digests again.
TEST_P(DriftIn, ReplaysToTheBit) {
  const Replayed first = run(drift_log(options_of(4, "on")), GetParam());
  ASSERT_GE(count_of(first.log, "$FPPOS"), 10U);
  const Replayed again = run(first.log, GetParam(), true);
  EXPECT_GT(again.outcome.check.compared, 10U);
  EXPECT_EQ(again.outcome.check.differing, 0U);
  EXPECT_EQ(again.outcome.result.digest, first.outcome.result.digest);
  EXPECT_EQ(again.log, first.log);
}

// Switched off, the robot goes on from where it thinks it is: one step of odometry from its last corrected pose.
TEST_P(DriftIn, SwitchedOffItStaysWhereItIs) {
  std::string log = drift_log(options_of(5, "on"));
  const std::size_t middle = log.find('\n', log.size() * 2 / 3) + 1;
  log.insert(middle, setting("correct.pose", "off"));
  const Replayed stopped = run(log, GetParam());
  const auto& path = stopped.outcome.result.path;
  const Replayed odometry = run(drift_log(options_of(5, "off")), GetParam());
  const auto& raw = odometry.outcome.result.path;
  ASSERT_EQ(path.size(), raw.size());
  double off = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double step = std::hypot(path[i].x - path[i - 1].x, path[i].y - path[i - 1].y);
    const double driven = std::hypot(raw[i].x - raw[i - 1].x, raw[i].y - raw[i - 1].y);
    EXPECT_LT(step, driven + 0.12) << i;  // no jump back
    off = std::hypot(path[i].x - raw[i].x, path[i].y - raw[i].y);
    if (i > path.size() * 3 / 4) {
      EXPECT_NEAR(step, driven, 1e-4) << i;
    }
  }
  EXPECT_GT(off, 0.01);
}

// By itself it corrects what drifts, and leaves alone what does not.
TEST_P(DriftIn, ByItselfItCorrectsWhatDrifts) {
  DriftOptions options = options_of(6, "auto");
  options.profile = GetParam();
  const DriftResult drifting = run_drift(options);
  options.correct = "off";
  EXPECT_LT(drifting.position, 0.7 * run_drift(options).position);
  options.drift = drifts()[kNone];
  options.correct = "auto";
  EXPECT_LT(run_drift(options).position, 0.002);
}

// Four times as careful as it would have to be, it still finds its way.
TEST_P(DriftIn, ConfiguredTooMuchDriftItDoesNotDiverge) {
  DriftOptions options = options_of(7, "off");
  options.profile = GetParam();
  const double raw = run_drift(options).position;
  options.correct = "on";
  options.configured = "30";
  EXPECT_LT(run_drift(options).position, raw);
}

INSTANTIATE_TEST_SUITE_P(Profiles, DriftIn, testing::Values("micro", "small", "full"));

// Lost pieces, and now and then something else taken for an object: no worse off than by odometry, and the map is
// there.
TEST(Drift, WrongBlobsDoNotDestroyTheMap) {
  double raw = 0;
  double corrected = 0;
  double hybrid = 0;
  constexpr unsigned kScenes = 6;
  for (unsigned seed = 11; seed < 11 + kScenes; ++seed) {
    DriftOptions options = options_of(seed, "off");
    options.level = "4";
    raw += run_drift(options).position;
    options.correct = "on";
    const DriftResult result = run_drift(options);
    corrected += result.position;
    hybrid += result.sum.at("hybrid") / kScenes;
  }
  EXPECT_LT(corrected, 0.7 * raw);
  EXPECT_LT(hybrid, 105);
}

}  // namespace
}  // namespace fencepost::test
