#include "hal/base/result.hpp"

#include <gtest/gtest.h>

namespace fencepost::base {
namespace {

struct Pair {
  int first = 0;
  int second = 0;
};

TEST(Result, HoldsAValue) {
  const Result<Pair> result = Pair{3, 4};
  ASSERT_TRUE(result.ok());
  EXPECT_TRUE(static_cast<bool>(result));
  EXPECT_EQ(result.value().first, 3);
  EXPECT_EQ((*result).second, 4);
  EXPECT_EQ(result->second, 4);
}

TEST(Result, HoldsAReason) {
  const Result<Pair> result = Error::kFull;
  ASSERT_FALSE(result.ok());
  EXPECT_FALSE(static_cast<bool>(result));
  EXPECT_EQ(result.error(), Error::kFull);
}

TEST(Result, TakesAnErrorTypeOfTheCaller) {
  enum class Refusal { kNone, kTooNear };
  const Result<int, Refusal> result = Refusal::kTooNear;
  EXPECT_EQ(result.error(), Refusal::kTooNear);
}

TEST(ResultDeath, TrapsOnTheValueOfAnError) {
  const Result<Pair> result = Error::kNotReady;
  EXPECT_DEATH(static_cast<void>(result.value()), "");
  EXPECT_DEATH(static_cast<void>(result->first), "");
}

TEST(ResultDeath, TrapsOnTheErrorOfAValue) {
  const Result<Pair> result = Pair{};
  EXPECT_DEATH(static_cast<void>(result.error()), "");
}

}  // namespace
}  // namespace fencepost::base
