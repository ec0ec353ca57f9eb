#include "drivers/wire/largest_first.hpp"

#include <gtest/gtest.h>

namespace fencepost::wire {
namespace {

sensor::Blob wide(std::int16_t width, std::uint8_t signature = 1) {
  return {signature, 0, 0, static_cast<std::int16_t>(width - 1), 0, {}, {}, 0, {}};
}

TEST(LargestFirst, SortsAndKeepsTheOrderOfEquals) {
  Blobs blobs;
  EXPECT_FALSE(insert_largest_first(blobs, wide(5, 1)));
  EXPECT_FALSE(insert_largest_first(blobs, wide(9, 2)));
  EXPECT_FALSE(insert_largest_first(blobs, wide(5, 3)));
  EXPECT_FALSE(insert_largest_first(blobs, wide(7, 4)));
  ASSERT_EQ(blobs.size(), 4U);
  EXPECT_EQ(blobs[0].signature, 2);
  EXPECT_EQ(blobs[1].signature, 4);
  EXPECT_EQ(blobs[2].signature, 1);
  EXPECT_EQ(blobs[3].signature, 3);
}

TEST(LargestFirst, FullTheSmallestGoes) {
  Blobs blobs;
  for (std::int16_t i = 1; i <= 16; ++i) EXPECT_FALSE(insert_largest_first(blobs, wide(i)));
  EXPECT_TRUE(insert_largest_first(blobs, wide(1)));
  EXPECT_EQ(blobs[15].x2, 0);
  EXPECT_TRUE(insert_largest_first(blobs, wide(99)));
  EXPECT_EQ(blobs[0].x2, 98);
  EXPECT_EQ(blobs[15].x2, 1);
  EXPECT_EQ(blobs.size(), 16U);
}

}  // namespace
}  // namespace fencepost::wire
