// Every driver, one hostile hour.
#include <gtest/gtest.h>

#include <string>

#include "tests/drivers/bench/hostile_hours.hpp"

namespace fencepost::test {
namespace {

class EveryDriver : public testing::TestWithParam<HostileCase> {};

TEST_P(EveryDriver, SurvivesAHostileHour) {
  const HostileFigures figures = run_hostile_hours(GetParam(), 1, 1);
  RecordProperty("samples", std::to_string(figures.samples));
  RecordProperty("lost", std::to_string(figures.lost()));
  RecordProperty("undetected", std::to_string(figures.undetected));
  for (const std::string& fault : hostile_faults(figures, GetParam().limits)) ADD_FAILURE() << fault;
}

INSTANTIATE_TEST_SUITE_P(All, EveryDriver, testing::ValuesIn(hostile_cases().begin(), hostile_cases().end()),
                         TestName());

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
