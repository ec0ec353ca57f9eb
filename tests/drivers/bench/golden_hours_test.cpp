// Golden minutes: thrice six of each driver's hostile minutes give the figures of its table. They are within their
// limits by hostile_test; here they are what they were.
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <tuple>

#include "tests/drivers/bench/figures.hpp"
#include "tests/drivers/bench/hostile_hours.hpp"

namespace fencepost::test {
namespace {

constexpr double kGoldenHours = 0.1;
constexpr std::uint32_t kGoldenSeeds[] = {7, 8, 9};

std::string golden_row(const HostileFigures& f) {
  std::ostringstream row;
  row << f.samples << "," << f.corrupted << "," << f.whole << "," << f.right_in_calm << "," << f.undetected << ","
      << f.held_back << "," << f.disorder << "," << f.longest_gap.raw << "," << f.longest_recovery.raw << ","
      << f.longest_queue << "," << std::hex << f.said;
  return row.str();
}

class GoldenHours : public testing::TestWithParam<std::tuple<HostileCase, std::uint32_t>> {};

TEST_P(GoldenHours, GiveTheSameFigures) {
  const auto& [driver, seed] = GetParam();
  expect_figures(driver.name, "seed " + std::to_string(seed), golden_row(run_hostile_hours(driver, kGoldenHours, seed)),
                 "samples, bytes damaged, whole, right, undetected, held back, disorder, longest gap, recovery and "
                 "queue, digest of samples, link states and counts");
}

INSTANTIATE_TEST_SUITE_P(All, GoldenHours,
                         testing::Combine(testing::ValuesIn(hostile_cases().begin(), hostile_cases().end()),
                                          testing::ValuesIn(kGoldenSeeds)));

TEST(GoldenHoursTable, HasARowForEachCaseAndSeed) {
  EXPECT_EQ(rows_of_figures("seed "), std::size(kGoldenSeeds) * hostile_cases().size());
}

}  // namespace
}  // namespace fencepost::test
