#include "host/video/jpeg.hpp"

#include <gtest/gtest.h>

#include "tests/host/video/files.hpp"
#include "tests/text.hpp"

namespace fencepost::host {
namespace {

using test::octets;

class Jpeg : public ::testing::Test {
 protected:
  Jpeg() { testing::paint(picture_, 8, 4, 23, 11, {220, 120, 20}); }
  RgbPicture picture_ = testing::plain(40, 24, {90, 110, 130});
  JpegDecoder decoder_;
};

TEST_F(Jpeg, DecodesWhatWasEncoded) {
  ASSERT_EQ(JpegDecoder::missing(), "");
  const std::string bytes = encode_jpeg(picture_);
  const auto decoded = decoder_.decode(octets(bytes));
  ASSERT_TRUE(decoded.ok());
  EXPECT_EQ(decoded->width, 40);
  EXPECT_EQ(decoded->height, 24);
  const RgbPicture again = to_rgb(*decoded);
  for (const auto& [u, v] : {std::pair(2, 2), std::pair(12, 8), std::pair(20, 6), std::pair(38, 22)}) {
    EXPECT_NEAR(again.at(u, v).red, picture_.at(u, v).red, 6);
    EXPECT_NEAR(again.at(u, v).green, picture_.at(u, v).green, 6);
    EXPECT_NEAR(again.at(u, v).blue, picture_.at(u, v).blue, 6);
  }
}

// Webcams leave the Huffman tables out, since all of them have the same.
TEST_F(Jpeg, DecodesWithoutHuffmanTables) {
  std::string bytes = encode_jpeg(picture_);
  std::size_t left_out = 0;
  for (std::size_t at = 2; at + 4 < bytes.size();) {
    const auto marker = static_cast<unsigned char>(bytes[at + 1]);
    const std::size_t size =
        2 + (std::size_t{static_cast<unsigned char>(bytes[at + 2])} << 8U) + static_cast<unsigned char>(bytes[at + 3]);
    if (marker == 0xDA) break;
    if (marker == 0xC4) {
      bytes.erase(at, size);
      ++left_out;
    } else {
      at += size;
    }
  }
  ASSERT_GT(left_out, 0U);
  EXPECT_TRUE(decoder_.decode(octets(bytes)).ok());
}

TEST_F(Jpeg, RefusesWhatIsDamaged) {
  const std::string bytes = encode_jpeg(picture_);
  EXPECT_FALSE(decoder_.decode({}).ok());
  for (const double part : {0.1, 0.5, 0.9}) {
    const std::string cut = bytes.substr(0, static_cast<std::size_t>(part * static_cast<double>(bytes.size())));
    EXPECT_EQ(decoder_.decode(octets(cut)).error(), base::Error::kBadInput) << part;
  }
  EXPECT_TRUE(decoder_.decode(octets(bytes)).ok()) << "and goes on";
}

TEST(ToRgb, KnowsTheLayouts) {
  // Y 81, U 90, V 240 in limited range is pure red, as BT.601 has it. In full range it is Y 76, U 85, V 255.
  const std::vector<std::uint8_t> limited = {81, 90, 81, 240};
  const std::vector<std::uint8_t> full = {76, 85, 76, 255};
  for (const auto& [layout, bytes] :
       {std::pair(bus::PixelLayout::kYuyv, limited), std::pair(bus::PixelLayout::kYuyvFull, full)}) {
    const RgbPicture rgb = to_rgb({layout, 2, 1, 4, bytes, {}});
    for (int u = 0; u < 2; ++u) {
      EXPECT_NEAR(rgb.at(u, 0).red, 254, 2);
      EXPECT_NEAR(rgb.at(u, 0).green, 0, 2);
      EXPECT_NEAR(rgb.at(u, 0).blue, 0, 2);
    }
  }
}

}  // namespace
}  // namespace fencepost::host
