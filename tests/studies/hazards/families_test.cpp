// Every cell of the table asks something, and the same seed gives the same.
#include <gtest/gtest.h>

#include "tests/studies/hazards/cell.hpp"

namespace fencepost::test {
namespace {

Conditions conditions_of(const Cell& cell) { return {noise_levels({cell.level.empty() ? "2" : cell.level}).front()}; }

class EveryFamily : public testing::TestWithParam<std::size_t> {};

TEST_P(EveryFamily, AsksAndRepeats) {
  const Family family = families()[GetParam()];
  ASSERT_FALSE(family.cells.empty());
  for (const Cell& cell : family.cells) {
    Outcome sum;
    for (unsigned seed = 1; seed < 10 && sum.asked == 0; ++seed) sum.add(cell.run(seed, conditions_of(cell)));
    EXPECT_GT(sum.asked, 0U) << cell.scene;
    EXPECT_EQ(sum.measures.size(), sum.asked) << cell.scene;
    EXPECT_LE(sum.kept, sum.asked) << cell.scene;
    EXPECT_LE(sum.grazes, sum.false_stops) << cell.scene;
  }
  const Cell& last = family.cells.back();
  const Outcome once = last.run(1, conditions_of(last));
  const Outcome twice = last.run(1, conditions_of(last));
  EXPECT_EQ(once.measures, twice.measures);
  EXPECT_EQ(once.seconds, twice.seconds);
  EXPECT_EQ(once.failures, twice.failures);
}

INSTANTIATE_TEST_SUITE_P(Families, EveryFamily, testing::Range(std::size_t{0}, families().size()));

}  // namespace
}  // namespace fencepost::test
