// The small boards' division beside the desk's.
#include "hal/mcu/division/division.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <random>

namespace fencepost::mcu {
namespace {

using division::divide;

template <class Int>
void expect_as_here(Int n, Int d) {
  const auto parts = divide(n, d);
  EXPECT_EQ(parts.quotient, n / d) << +n << " / " << +d;
  EXPECT_EQ(parts.remainder, n % d) << +n << " % " << +d;
}

/// Of all lengths, so that quotients are, too.
template <class Int>
class Numbers {
 public:
  Int next() {
    const std::uint64_t bits = random_();
    return static_cast<Int>(static_cast<Int>(bits) >> (random_() % std::numeric_limits<Int>::digits));
  }
  Int next_but_zero() {
    const Int number = next();
    return number == 0 ? Int{1} : number;
  }

 private:
  std::mt19937_64 random_{42};
};

template <class Int>
class Division : public testing::Test {};
using Integers = testing::Types<std::uint32_t, std::int32_t, std::uint64_t, std::int64_t>;
TYPED_TEST_SUITE(Division, Integers);

TYPED_TEST(Division, OfManyNumbers) {
  Numbers<TypeParam> numbers;
  for (int i = 0; i < 100'000; ++i) {
    const TypeParam n = numbers.next();
    const TypeParam d = numbers.next_but_zero();
    if (d == static_cast<TypeParam>(-1)) continue;  // the least number by it does not fit
    expect_as_here(n, d);
    if (this->HasFailure()) return;
  }
}

TYPED_TEST(Division, AtTheEndsOfTheRange) {
  constexpr TypeParam kMin = std::numeric_limits<TypeParam>::min();
  constexpr TypeParam kMax = std::numeric_limits<TypeParam>::max();
  for (const TypeParam n : {kMin, static_cast<TypeParam>(kMin + 1), TypeParam{0}, TypeParam{1}, kMax}) {
    for (const TypeParam d : {static_cast<TypeParam>(kMin + 1), TypeParam{1}, TypeParam{2}, kMax}) {
      expect_as_here(n, d);
    }
  }
}

// The ABI leaves this open, and so does the language: it must only come to an end.
TYPED_TEST(Division, ByZeroEnds) {
  EXPECT_EQ(divide(TypeParam{7}, TypeParam{0}).quotient, TypeParam{0});
  EXPECT_EQ(divide(TypeParam{7}, TypeParam{0}).remainder, TypeParam{7});
}

TEST(SignedDivision, IsTowardsZeroAndTheRemainderHasTheDividendsSign) {
  EXPECT_EQ(divide(-7, 2).quotient, -3);
  EXPECT_EQ(divide(-7, 2).remainder, -1);
  EXPECT_EQ(divide(7, -2).quotient, -3);
  EXPECT_EQ(divide(7, -2).remainder, 1);
}

}  // namespace
}  // namespace fencepost::mcu
