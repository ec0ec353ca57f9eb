#include "host/render/png.hpp"

#include <gtest/gtest.h>
#include <png.h>

namespace fencepost::host {
namespace {

Picture gradient() {
  Picture picture{7, 5, {}};
  for (unsigned i = 0; i < 7 * 5 * 3; ++i) picture.rgb.push_back(static_cast<std::uint8_t>(i * 2));
  return picture;
}

TEST(Png, IsReadBackAsItWas) {
  const std::string bytes = png(gradient());
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()), 0);
  EXPECT_EQ(image.width, 7U);
  EXPECT_EQ(image.height, 5U);
  image.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> rgb(PNG_IMAGE_SIZE(image));
  ASSERT_NE(png_image_finish_read(&image, nullptr, rgb.data(), 0, nullptr), 0);
  EXPECT_EQ(rgb, gradient().rgb);
}

TEST(Png, IsTheSameEachTime) { EXPECT_EQ(png(gradient()), png(gradient())); }

TEST(Png, RefusesAnImageWithoutPixels) { EXPECT_THROW(png(Picture{}), std::runtime_error); }

}  // namespace
}  // namespace fencepost::host
