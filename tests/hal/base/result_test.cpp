#include "hal/base/result.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

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

// A frame of 16 blobs would be cleared at each poll that has nothing.
TEST(Result, MakesNoValueOnError) {
  static int made = 0;
  struct Counted {
    Counted() { ++made; }
  };
  const Result<Counted> result = Error::kNotReady;
  EXPECT_EQ(result.error(), Error::kNotReady);
  EXPECT_EQ(made, 0);
}

TEST(Result, HoldsWhatIsNoPlainData) {
  const Result<std::vector<int>, std::string> good = std::vector{1, 2, 3};
  const Result<std::vector<int>, std::string> bad = std::string("a reason that is too long to be kept in place");
  EXPECT_EQ(good->size(), 3U);
  EXPECT_EQ(bad.error(), "a reason that is too long to be kept in place");
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
