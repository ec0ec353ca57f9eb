// Every driver keeps the contract, with the figures of its table.
#include "tests/drivers/contract/contract.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <sstream>

#include "tests/drivers/bench/comeback.hpp"
#include "tests/drivers/bench/figures.hpp"

namespace fencepost::test {
namespace {

using sensor::LinkState;

class DriverContract : public testing::TestWithParam<HostileCase> {
 protected:
  void keeps(std::string_view name) {
    for (const ContractCase& contract : contract_cases()) {
      if (contract.name != name) continue;
      const Kept kept = contract.run(*GetParam().make({}));
      for (const std::string& broken : kept.broken) ADD_FAILURE() << broken;
      const HostileLimits& limits = GetParam().limits;
      const bool sealed = contract.one_fault && limits.undetected_share < kNoSum && !limits.sealed_in_parts;
      EXPECT_TRUE(!sealed || kept.unnoticed == 0) << "it has a checksum";
      std::ostringstream row;
      row << kept.tries << ',' << kept.unnoticed << ',' << kept.longest.raw / 10 << ',' << kept.total.raw / 10;
      expect_figures(GetParam().name, name, row.str(),
                     "tries, samples that the device did not send, ms until two right ones, the longest and all");
      return;
    }
    FAIL() << "no such case";
  }
};

TEST_P(DriverContract, FramesComeInOrderAndNothingIsSaidToBeEmpty) { keeps("calm"); }
TEST_P(DriverContract, GarbageIsPassedOver) { keeps("garbage"); }
TEST_P(DriverContract, AFrameCutAnywhereCostsNoLaterOne) { keeps("cut"); }
TEST_P(DriverContract, ADamagedByteIsRefusedWhereThereIsAChecksum) { keeps("flip"); }
TEST_P(DriverContract, AFrameMayComeInAnyTwoParts) { keeps("split"); }
TEST_P(DriverContract, MoreThanAFrameHoldsIsCounted) { keeps("crowd"); }
TEST_P(DriverContract, AFrameWithoutEndIsGivenUp) { keeps("flood"); }
TEST_P(DriverContract, RandomBytesMakeNothingImpossible) { keeps("random"); }
TEST_P(DriverContract, ALostLinkLeavesNothingToBelieve) { keeps("lost link"); }
TEST_P(DriverContract, WithoutItsDeviceItIsNotReady) { keeps("unready"); }

TEST_P(DriverContract, ComesBackFromAStallAnUnplugAndAPowerCycle) {
  const Comeback day = spend_day(GetParam());
  EXPECT_EQ(day.before, LinkState::kSilent);
  EXPECT_EQ(day.working, LinkState::kOk);
  EXPECT_EQ(day.stalled, LinkState::kSilent);
  EXPECT_EQ(day.after_stall, LinkState::kOk);
  EXPECT_EQ(day.unplugged, LinkState::kAbsent);
  EXPECT_EQ(day.replugged, LinkState::kOk);
  EXPECT_EQ(day.after_power_cycle, LinkState::kOk);
  EXPECT_GE(day.samples_after_power_cycle, 20U);
  EXPECT_EQ(day.wrong, 0U) << "on a good cable";
}

// On a good cable, whenever the silence began and however long it was; beyond what the device itself takes to start.
TEST_P(DriverContract, GoesOnWithinASecondOfASilence) {
  constexpr base::Duration kSecond = base::milliseconds(1'000);
  const HostileLimits& limits = GetParam().limits;
  const Recovery recovery = measure_recovery(GetParam());
  const base::Duration after_silence = limits.reset_starts_it ? limits.own_start + kSecond : kSecond;
  EXPECT_TRUE(recovery.wrong == 0 || limits.sealed_in_parts) << recovery.wrong;
  EXPECT_EQ(recovery.stale, 0U);
  EXPECT_LE(recovery.stall, after_silence);
  EXPECT_LE(recovery.unplug, after_silence);
  EXPECT_LE(recovery.power, limits.own_start + kSecond);
  EXPECT_GE(recovery.power, limits.own_start) << "it starts sooner than it is said to";
  std::array<char, 80> figures{};
  std::snprintf(figures.data(), figures.size(), "%.1f,%.2f,%.2f,%.2f", limits.own_start.to_double(),
                recovery.stall.to_double(), recovery.unplug.to_double(), recovery.power.to_double());
  expect_figures(GetParam().name, "silence", figures.data(),
                 "s: its own start; the longest until a right sample after a stall, an unplug, a power cycle");
}

TEST_P(DriverContract, DoesNotTakeNoiseForItsDevice) {
  const std::optional<Noise> noise = hear_noise(GetParam());
  if (!noise) return;  // its cable carries whole transfers
  EXPECT_GT(noise->bytes, 100'000U) << "it was not looked at";
  EXPECT_EQ(noise->working, 0U) << "of " << noise->polls;
  EXPECT_EQ(noise->samples, 0U);
}

INSTANTIATE_TEST_SUITE_P(All, DriverContract, testing::ValuesIn(hostile_cases().begin(), hostile_cases().end()),
                         TestName());

TEST(DriverContractTable, HasARowForEachDriverAndCase) {
  const std::size_t rows = hostile_cases().size() * (contract_cases().size() + 1);
  EXPECT_EQ(rows_of_figures() - rows_of_figures("seed "), rows);
}

}  // namespace
}  // namespace fencepost::test
