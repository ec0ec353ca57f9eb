// Every driver, one hostile hour, and a good day with one fault of each kind.
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <sstream>

#include "tests/drivers/bench/hostile_cases.hpp"

namespace fencepost::test {
namespace {

using sensor::LinkState;

class EveryDriver : public testing::TestWithParam<HostileCase> {};

TEST_P(EveryDriver, SurvivesAHostileHour) {
  const HostileFigures figures = GetParam().hours(1, 1);
  RecordProperty("samples", std::to_string(figures.samples));
  RecordProperty("lost", std::to_string(figures.lost()));
  RecordProperty("undetected", std::to_string(figures.undetected));
  for (const std::string& fault : hostile_faults(figures, GetParam().limits)) ADD_FAILURE() << fault;
}

TEST_P(EveryDriver, ComesBackFromAStallAnUnplugAndAPowerCycle) {
  const Comeback day = GetParam().comeback();
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
TEST_P(EveryDriver, GoesOnWithinASecondOfASilence) {
  constexpr base::Duration kSecond = base::milliseconds(1'000);
  const HostileLimits& limits = GetParam().limits;
  const Recovery recovery = GetParam().recovery();
  const base::Duration after_silence = limits.reset_starts_it ? limits.own_start + kSecond : kSecond;
  EXPECT_LE(recovery.stall, after_silence);
  EXPECT_LE(recovery.unplug, after_silence);
  EXPECT_LE(recovery.power, limits.own_start + kSecond);
  EXPECT_GE(recovery.power, limits.own_start) << "it starts sooner than it is said to";
  std::ostringstream document;
  document << std::ifstream(FENCEPOST_SOURCE_DIR "/host/share/doc/emulate.md").rdbuf();
  char row[120];
  std::snprintf(row, sizeof row, "| `%s` | %.1f | %.2f | %.2f | %.2f |\n", std::string(GetParam().name).c_str(),
                limits.own_start.to_double(), recovery.stall.to_double(), recovery.unplug.to_double(),
                recovery.power.to_double());
  EXPECT_NE(document.str().find(row), std::string::npos) << "host/share/doc/emulate.md has no line\n" << row;
}

TEST_P(EveryDriver, DoesNotTakeNoiseForItsDevice) {
  const std::optional<Noise> noise = GetParam().noise();
  if (!noise) return;  // its cable carries whole transfers
  EXPECT_GT(noise->bytes, 100'000U) << "it was not looked at";
  EXPECT_EQ(noise->working, 0U) << "of " << noise->polls;
  EXPECT_EQ(noise->samples, 0U);
}

INSTANTIATE_TEST_SUITE_P(All, EveryDriver, testing::ValuesIn(hostile_cases().begin(), hostile_cases().end()),
                         [](const auto& driver) {
                           std::string name;
                           for (const char c : driver.param.name) {
                             if (std::isalnum(static_cast<unsigned char>(c)) != 0) name += c;
                           }
                           return name;
                         });

// The judge itself.
TEST(HostileFigures, EveryFaultIsReported) {
  HostileFigures good;
  good.hours = 1;
  good.samples = 100;
  good.corrupted = good.corrupted_in_calm = 2'000;
  good.faults = 200;
  good.whole = good.right_in_calm = 100;
  const HostileLimits limits{0.01, 100, base::milliseconds(1'000)};
  EXPECT_TRUE(hostile_faults(good, limits).empty());
  const auto faults = [&](auto change) {
    HostileFigures bad = good;
    change(bad);
    return hostile_faults(bad, limits).size();
  };
  EXPECT_EQ(faults([](auto& f) { f.samples = 99; }), 1U);
  EXPECT_EQ(faults([](auto& f) { f.faults = 100; }), 1U);
  EXPECT_EQ(faults([](auto& f) { f.corrupted = 1'000; }), 1U);
  EXPECT_EQ(faults([](auto& f) { f.whole += 2'401; }), 1U);
  EXPECT_EQ(faults([](auto& f) { f.undetected = 2; }), 1U);
  EXPECT_EQ(faults([](auto& f) { f.disorder = 1; }), 1U);
  EXPECT_EQ(faults([](auto& f) { f.longest_gap = base::milliseconds(1'001); }), 1U);
  EXPECT_EQ(faults([](auto& f) { f.longest_recovery = base::milliseconds(1'001); }), 1U);
  EXPECT_EQ(faults([](auto& f) { f.longest_queue = 6'001; }), 1U);
  EXPECT_EQ(faults([](auto& f) { f.heap_growth = 1 << 20; }), 1U);
}

}  // namespace
}  // namespace fencepost::test
