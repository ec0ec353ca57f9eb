// Fifty robots in storms; and each planted fault is found.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tests/studies/storm/other_links.hpp"
#include "tests/studies/storm/shrink.hpp"

namespace fencepost::test {
namespace {

/// Seeds here are judged; none was looked at while anything was chosen.
constexpr std::uint64_t kFirst = 2'000'001;
constexpr std::uint64_t kRobots = 50;  // a seed each
/// Of each robot: few, so that sanitizers can follow. `toolchain/long storm` has ten minutes each.
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

// Seed 7 is a HuskyLens 2, which runs another algorithm then.
TEST(StormReboots, DevicesSwitchedOffAndOnUnnoticedComeBack) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Plan plan = plan_of(seed, 1.0);
    plan.events = unnoticed_reboots(seed, plan.milliseconds);
    ASSERT_FALSE(plan.events.empty());
    for (const Fault& fault : run_storm(plan).faults) {
      ADD_FAILURE() << fault.check << ": " << fault.sentence << "\n  " << describe(plan);
    }
  }
}

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

// Each link gives frames while nothing is wrong: a fault that is not found could be a camera that is not there.
TEST(StormLinks, AllAreDrawnAndAllBringFrames) {
  using enum host::PlaceKind;
  std::map<std::pair<host::PlaceKind, std::string>, Plan> plans;
  for (std::uint64_t i = 0; i < 400; ++i) {
    Plan plan = plan_of(kFirst + i, 0.2);
    plans.try_emplace({plan.link, plan.link == kTty ? "any" : plan.camera}, std::move(plan));
  }
  std::map<host::PlaceKind, int> links;
  for (auto& [link, plan] : plans) {
    ++links[link.first];
    plan.console_speed = 1'000;
    const RunOutcome outcome = run_storm(with_events(plan, {}));
    EXPECT_GT(outcome.figures.frames, 10U) << describe(plan);
    for (const Fault& fault : outcome.faults) ADD_FAILURE() << describe(plan) << ": " << fault.sentence;
  }
  EXPECT_EQ(links[kI2c], 7) << "Grove, HuskyLens 1 and 2, NXTCam, Pixy, Pixy2 and 2.1";
  EXPECT_EQ(links[kSpi], 2);
  EXPECT_EQ(links[kUsb], 3);
  EXPECT_EQ(links[kTty], 1);
}

TEST(StormLinks, ATwoWireBusHasItsFaults) {
  emulate::EmulatedDevice device;
  device.make = [](const emulate::Colours&) { return on_two_wires("pixy2"); };
  FarEnd end(device, {}, std::nullopt, 7, base::Time{});
  constexpr std::size_t kExpected = 16;
  constexpr std::uint8_t kAddress = 0x54;
  const auto read = [&] { return end.transfer(kAddress, std::vector<std::uint8_t>{0xAE}, kExpected); };
  for (int i = 0; i < 200; ++i) ASSERT_EQ(read().in->size(), kExpected);
  EXPECT_FALSE(end.transfer(kAddress + 1, {}, kExpected).in) << "nobody is there";
  end.set_noise(0.05);
  int refused = 0;
  int short_reads = 0;
  int held = 0;
  for (int i = 0; i < 400; ++i) {
    const Transferred transfer = read();
    refused += transfer.in ? 0 : 1;
    short_reads += transfer.in && transfer.in->size() < kExpected ? 1 : 0;
    held += transfer.stretched > base::milliseconds(100) ? 1 : 0;  // longer than an adapter waits
  }
  EXPECT_GT(refused, 0);
  EXPECT_GT(short_reads, 0);
  EXPECT_GT(held, 0);
  end.set_noise(0);
  end.set_power(false, base::Time{});
  EXPECT_FALSE(read().in);
}

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
