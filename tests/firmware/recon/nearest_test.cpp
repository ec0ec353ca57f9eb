// Nearest whole numbers: both ways, bit by bit.
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>

#include "firmware/recon/floor_frame.hpp"

namespace fencepost::test {
namespace {

using recon::nearest_by_bits;
using recon::nearest_by_float;
using recon::nearest_whole;

constexpr std::uint32_t kSign = 0x8000'0000;

void expect_same(std::uint32_t bits) {
  const auto value = std::bit_cast<float>(bits);
  ASSERT_EQ(nearest_by_bits(value), nearest_by_float(value)) << value;
}

TEST(Nearest, GoesHalfAwayFromZero) {
  for (const auto& [value, whole] : {std::pair{0.0F, 0},
                                     {-0.0F, 0},
                                     {0.25F, 0},
                                     {0.5F, 1},
                                     {-0.5F, -1},
                                     {0.75F, 1},
                                     {1.49F, 1},
                                     {1.5F, 2},
                                     {-2.5F, -3},
                                     {8388607.5F, 8388608}}) {
    EXPECT_EQ(nearest_by_bits(value), whole) << value;
    EXPECT_EQ(nearest_by_float(value), whole) << value;
    EXPECT_EQ(nearest_whole(value), whole) << value;
  }
}

TEST(Nearest, StaysWithinItsLimit) {
  for (const auto& [value, whole] :
       {std::pair{99.4F, 99}, {99.6F, 100}, {100.5F, 100}, {-1e30F, -100}, {-99.5F, -100}}) {
    EXPECT_EQ(nearest_whole(value, 100), whole) << value;
  }
}

// Every float below 2^30 was compared once (1.5 s a sign); here those beside halves, and each 509th.
TEST(Nearest, IsTheSameFromBitsAsFromFloats) {
  constexpr std::uint32_t kMax = 157U << 23;  // 2^30
  for (std::uint32_t bits = 0; bits < kMax; bits += 509) {
    ASSERT_NO_FATAL_FAILURE(expect_same(bits));
    ASSERT_NO_FATAL_FAILURE(expect_same(bits | kSign));
  }
  for (std::uint32_t whole = 0; whole < 1U << 22; whole = whole < 5000 ? whole + 1 : whole + 977) {
    const auto half = std::bit_cast<std::uint32_t>(static_cast<float>(whole) + 0.5F);
    for (std::uint32_t bits = half - 3; bits <= half + 3; ++bits) {
      ASSERT_NO_FATAL_FAILURE(expect_same(bits));
      ASSERT_NO_FATAL_FAILURE(expect_same(bits | kSign));
    }
  }
}

}  // namespace
}  // namespace fencepost::test
