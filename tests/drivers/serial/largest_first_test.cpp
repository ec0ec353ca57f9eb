#include "drivers/serial/largest_first.hpp"

#include <gtest/gtest.h>

namespace fencepost::serial {
namespace {

sensor::Blob blob(std::uint8_t signature, std::uint32_t pixels, std::int16_t side = 1) {
  sensor::Blob blob;
  blob.signature = signature;
  blob.pixels = pixels;
  blob.x2 = static_cast<std::int16_t>(side - 1);
  blob.y2 = static_cast<std::int16_t>(side - 1);
  return blob;
}

TEST(LargestFirst, SortsByPixelsAndKeepsTheOrderOfEquals) {
  sensor::BlobFrame frame;
  for (const auto& next : {blob(1, 10), blob(2, 30), blob(3, 20), blob(4, 30), blob(5, 5)}) {
    EXPECT_TRUE(insert_largest_first(frame, next));
  }
  std::string order;
  for (const sensor::Blob& kept : frame.blobs) order += std::to_string(kept.signature);
  EXPECT_EQ(order, "24315");
}

TEST(LargestFirst, TheBoxStandsForPixelsThatAreNotTold) {
  sensor::BlobFrame frame;
  EXPECT_TRUE(insert_largest_first(frame, blob(1, 15)));
  EXPECT_TRUE(insert_largest_first(frame, blob(2, 0, 4)));  // 16
  EXPECT_EQ(frame.blobs[0].signature, 2);
}

TEST(LargestFirst, DropsTheSmallestOfAFullFrame) {
  sensor::BlobFrame frame;
  for (std::uint8_t i = 0; i < sensor::kMaxBlobs; ++i) EXPECT_TRUE(insert_largest_first(frame, blob(i, 100U + i)));
  EXPECT_FALSE(insert_largest_first(frame, blob(50, 99))) << "itself the smallest";
  EXPECT_EQ(frame.blobs[15].signature, 0);
  EXPECT_FALSE(insert_largest_first(frame, blob(51, 200)));
  EXPECT_EQ(frame.blobs[0].signature, 51);
  EXPECT_EQ(frame.blobs[15].signature, 1);
  EXPECT_EQ(frame.blobs.size(), 16U);
}

}  // namespace
}  // namespace fencepost::serial
