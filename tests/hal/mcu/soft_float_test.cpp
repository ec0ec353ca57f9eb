// The boards' float arithmetic beside the desk's: IEEE 754 says what each result is, to the last bit.
#include "hal/mcu/soft_float/float32.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "tests/hal/mcu/soft_float_numbers.hpp"

namespace fencepost::mcu {
namespace {

soft::Bits bits(float x) { return std::bit_cast<soft::Bits>(x); }
float value(soft::Bits x) { return std::bit_cast<float>(x); }
// Any NaN is as good as another.
soft::Bits plain(soft::Bits x) { return soft::is_nan(x) ? soft::kNan : x; }

constexpr int kRounds = 1'000'000;

TEST(SoftFloat, AddsSubtractsMultipliesAndDividesAsTheDeskDoes) {
  test::Numbers numbers(std::mt19937(42));
  for (int i = 0; i < kRounds; ++i) {
    const soft::Bits a = numbers.next();
    const soft::Bits b = numbers.next();
    ASSERT_EQ(plain(soft::add(a, b)), plain(bits(value(a) + value(b)))) << std::hex << a << " " << b;
    ASSERT_EQ(plain(soft::subtract(a, b)), plain(bits(value(a) - value(b)))) << std::hex << a << " " << b;
    ASSERT_EQ(plain(soft::multiply(a, b)), plain(bits(value(a) * value(b)))) << std::hex << a << " " << b;
    ASSERT_EQ(plain(soft::divide(a, b)), plain(bits(value(a) / value(b)))) << std::hex << a << " " << b;
  }
}

TEST(SoftFloat, ComparesAsTheDeskDoes) {
  test::Numbers numbers(std::mt19937(42));
  for (int i = 0; i < kRounds; ++i) {
    const soft::Bits a = numbers.next();
    const soft::Bits b = i % 8 == 0 ? a ^ (i % 16 == 0 ? soft::kSign : 0) : numbers.next();
    ASSERT_EQ(soft::less(a, b), value(a) < value(b)) << std::hex << a << " " << b;
    ASSERT_EQ(soft::less_or_equal(a, b), value(a) <= value(b)) << std::hex << a << " " << b;
    ASSERT_EQ(soft::equal(a, b), value(a) == value(b)) << std::hex << a << " " << b;
  }
}

TEST(SoftFloat, TakesRootsAsTheDeskDoes) {
  test::Numbers numbers(std::mt19937(42));
  for (int i = 0; i < kRounds; ++i) {
    const soft::Bits a = numbers.next();
    ASSERT_EQ(plain(soft::root(a)), plain(bits(std::sqrt(value(a))))) << std::hex << a;
  }
}

// Squares and their neighbours: where a root is exact, or only just not.
TEST(SoftFloat, TakesRootsNearSquares) {
  for (std::uint32_t n = 1; n < 4096; ++n) {
    const soft::Bits square = bits(static_cast<float>(n * n));
    for (const soft::Bits x : {square - 1, square, square + 1}) {
      ASSERT_EQ(soft::root(x), bits(std::sqrt(value(x)))) << std::hex << x;
    }
    EXPECT_EQ(value(soft::root(square)), static_cast<float>(n));
  }
}

// A quotient's digits may be too small, never too large: all of the 2^15 divisors.
TEST(SoftFloat, NeverTakesAReciprocalTooLarge) {
  for (std::uint32_t d = 0x8000; d <= 0xFFFF; ++d) {
    const std::uint32_t exact = (1U << 31) / (d + 1);
    ASSERT_LE(soft::reciprocal(d), exact) << d;
    ASSERT_LE(exact - soft::reciprocal(d), 6U) << d;
  }
}

TEST(SoftFloat, ConvertsIntegersAsTheDeskDoes) {
  std::mt19937_64 random(7);
  for (int i = 0; i < kRounds; ++i) {
    const auto wide = static_cast<std::int64_t>(random()) >> (random() % 64);
    const auto narrow = static_cast<std::int32_t>(random()) >> (random() % 32);
    ASSERT_EQ(value(soft::from_signed64(wide)), static_cast<float>(wide)) << wide;
    ASSERT_EQ(value(soft::from_unsigned64(static_cast<std::uint64_t>(wide))),
              static_cast<float>(static_cast<std::uint64_t>(wide)));
    ASSERT_EQ(value(soft::from_signed(narrow)), static_cast<float>(narrow)) << narrow;
    ASSERT_EQ(value(soft::from_unsigned(static_cast<std::uint32_t>(narrow))),
              static_cast<float>(static_cast<std::uint32_t>(narrow)));
  }
}

TEST(SoftFloat, CutsOffFractionsAsTheDeskDoes) {
  test::Numbers numbers(std::mt19937(42));
  int compared = 0;
  for (int i = 0; i < kRounds; ++i) {
    const soft::Bits a = numbers.next();
    const float x = std::fabs(value(a));
    if (x < 4.29e9F) {
      ASSERT_EQ(soft::amount(a), static_cast<std::uint32_t>(x)) << std::hex << a;
      ++compared;
    }
    if (x < 1.84e19F) {
      ASSERT_EQ(soft::amount64(a), static_cast<std::uint64_t>(x)) << std::hex << a;
    }
  }
  EXPECT_GT(compared, kRounds / 2);
}

TEST(SoftFloat, KnowsItsLimits) {
  constexpr float kInfinite = std::numeric_limits<float>::infinity();
  EXPECT_EQ(value(soft::divide(bits(1.0F), bits(-0.0F))), -kInfinite);
  EXPECT_TRUE(soft::is_nan(soft::divide(bits(0.0F), bits(0.0F))));
  EXPECT_TRUE(soft::is_nan(soft::subtract(bits(kInfinite), bits(kInfinite))));
  EXPECT_TRUE(soft::is_nan(soft::root(bits(-1.0F))));
  EXPECT_EQ(soft::root(bits(-0.0F)), bits(-0.0F));
  EXPECT_EQ(soft::add(bits(-0.0F), bits(-0.0F)), bits(-0.0F));
  EXPECT_EQ(soft::add(bits(1.5F), bits(-1.5F)), bits(0.0F));
  EXPECT_EQ(soft::multiply(1, bits(0.5F)), 0U);  // half the least number: to even
  EXPECT_EQ(soft::multiply(3, bits(0.5F)), 2U);  // one and a half of it
  EXPECT_EQ(soft::multiply(0x7F7F'FFFF, bits(2.0F)), soft::kInfinity);
  EXPECT_FALSE(soft::less(soft::kNan, bits(1.0F)) || soft::less_or_equal(bits(1.0F), soft::kNan));
}

}  // namespace
}  // namespace fencepost::mcu
