// Fifty robots in storms, and that what is planted is found.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/studies/storm/shrink.hpp"

namespace fencepost::test {
namespace {

/// Seeds here are judged, none was looked at while anything was chosen; each is half a minute, so that sanitizers can
/// follow. `toolchain/long storm` has ten minutes each.
constexpr std::uint64_t kFirst = 2'000'001;
constexpr std::uint64_t kRobots = 50;
constexpr double kMinutes = 0.5;

class Storm : public testing::TestWithParam<std::uint64_t> {};

TEST_P(Storm, FindsNothing) {
  constexpr std::uint64_t kEach = 5;
  std::uint64_t frames = 0;
  for (std::uint64_t i = 0; i < kEach; ++i) {
    const Plan plan = plan_of(kFirst + GetParam() * kEach + i, kMinutes);
    const RunOutcome outcome = run_storm(plan);
    frames += outcome.figures.frames;
    if (outcome.faults.empty()) continue;
    const Fault& fault = outcome.faults.front();
    ADD_FAILURE() << fault.check << ": " << fault.sentence << "\n  " << describe(plan)
                  << "\n  again: " << command_of(plan, shrunk(plan, Plant::kNone, fault.check, 60));
  }
  EXPECT_GT(frames, 100U);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Storm, testing::Range<std::uint64_t>(0, kRobots / 5));

struct Planted {
  Plant plant;
  const char* check;
};

class PlantedStorm : public testing::TestWithParam<Planted> {};

// In few of the fifty, so a found one is not luck.
TEST_P(PlantedStorm, IsFoundAndShrunk) {
  for (std::uint64_t i = 0; i < kRobots; ++i) {
    const Plan plan = plan_of(kFirst + i, kMinutes);
    const RunOutcome outcome = run_storm(plan, GetParam().plant);
    const bool found = std::any_of(outcome.faults.begin(), outcome.faults.end(),
                                   [](const Fault& fault) { return fault.check == GetParam().check; });
    if (!found) continue;
    const std::vector<std::size_t> numbers = shrunk(plan, GetParam().plant, GetParam().check, 8);
    EXPECT_LE(numbers.size(), plan.events.size());
    const RunOutcome again = run_storm(with_events(plan, numbers), GetParam().plant);
    EXPECT_TRUE(std::any_of(again.faults.begin(), again.faults.end(), [](const Fault& fault) {
      return fault.check == GetParam().check;
    })) << command_of(plan, numbers);
    return;
  }
  ADD_FAILURE() << GetParam().check << " was not found";
}

INSTANTIATE_TEST_SUITE_P(Faults, PlantedStorm,
                         testing::Values(Planted{Plant::kLostAlert, "silent-loss"},
                                         Planted{Plant::kLostFrame, "digest"}, Planted{Plant::kBrokenGuard, "guard"},
                                         Planted{Plant::kDeafPin, "pin"}, Planted{Plant::kMixedFlash, "flash"},
                                         Planted{Plant::kHalfKept, "flash"}));

// The same number, the same run: whatever the machine does meanwhile.
TEST(StormTwice, IsTheSame) {
  const Plan plan = plan_of(kFirst + 3, kMinutes);
  const RunOutcome first = run_storm(plan);
  const RunOutcome second = run_storm(plan);
  EXPECT_FALSE(first.text.empty());
  EXPECT_EQ(first.text, second.text);
}

}  // namespace
}  // namespace fencepost::test
