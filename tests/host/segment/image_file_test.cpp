#include "host/segment/image_file.hpp"

#include <gtest/gtest.h>
#include <png.h>
#include <turbojpeg.h>

#include <random>

#include "tests/host/segment/pictures.hpp"

namespace fencepost::host {
namespace {

cv::Mat colourful() {
  cv::Mat image = canvas(40, 24, kWall);
  paint(image, 4, 4, 11, 19, kRed);
  paint(image, 24, 8, 39, 15, kBlue);
  return image;
}

std::string png_of(const std::vector<std::uint8_t>& pixels, unsigned width, unsigned height, unsigned format) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = width;
  png.height = height;
  png.format = format;
  std::string bytes(100'000, '\0');
  png_alloc_size_t size = bytes.size();
  EXPECT_NE(png_image_write_to_memory(&png, bytes.data(), &size, 0, pixels.data(), 0, nullptr), 0);
  bytes.resize(size);
  return bytes;
}

std::string jpeg_of(const cv::Mat& image) {
  tjhandle encoder = tjInitCompress();
  unsigned char* data = nullptr;
  unsigned long size = 0;
  EXPECT_EQ(tjCompress2(encoder, image.data, image.cols, 0, image.rows, TJPF_BGR, &data, &size, TJSAMP_444, 95, 0), 0);
  std::string bytes(reinterpret_cast<char*>(data), size);
  tjFree(data);
  tjDestroy(encoder);
  return bytes;
}

void expect_same(const cv::Mat& a, const cv::Mat& b, int tolerance) {
  ASSERT_EQ(a.size(), b.size());
  ASSERT_EQ(b.type(), CV_8UC3);
  EXPECT_LE(cv::norm(a, b, cv::NORM_INF), tolerance);
}

std::string refusal(const std::string& bytes) {
  try {
    (void)decode_image(bytes, "it");
  } catch (const SegmentProblem& problem) {
    EXPECT_FALSE(problem.remedy.empty());
    return problem.message();
  }
  return "was accepted";
}

TEST(ImageFile, PngComesBackExactly) { expect_same(colourful(), decode_image(encode_png(colourful()), "it"), 0); }

TEST(ImageFile, JpegComesBackNearly) { expect_same(colourful(), decode_image(jpeg_of(colourful()), "it"), 40); }

TEST(ImageFile, GreyAlphaAndTheOrderOfChannels) {
  const cv::Mat grey = decode_image(png_of({7, 7, 200, 200}, 2, 2, PNG_FORMAT_GRAY), "it");
  EXPECT_EQ(grey.at<cv::Vec3b>(1, 1), cv::Vec3b(200, 200, 200));
  const cv::Mat rgb = decode_image(png_of({1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3}, 2, 2, PNG_FORMAT_RGB), "it");
  EXPECT_EQ(rgb.at<cv::Vec3b>(0, 0), cv::Vec3b(3, 2, 1));
  const cv::Mat clear = decode_image(png_of(std::vector<std::uint8_t>(16, 0), 2, 2, PNG_FORMAT_RGBA), "it");
  EXPECT_EQ(clear.at<cv::Vec3b>(0, 0), cv::Vec3b(255, 255, 255)) << "what is transparent is white";
}

TEST(ImageFile, OtherFilesAreRefused) {
  EXPECT_EQ(refusal(""), "it: is empty; copy it again, or take its line out of the table of poses");
  EXPECT_EQ(refusal("P6 2 2 255"), "it: is neither PNG nor JPEG; convert it to PNG");
  EXPECT_EQ(refusal(png_of({1}, 1, 1, PNG_FORMAT_GRAY)).rfind("it: is 1 x 1 px", 0), 0U);
}

// A file that was cut off holds grey or black where the rest was: nobody took these pixels.
TEST(ImageFile, CutFilesAreRefused) {
  const std::string png = encode_png(colourful());
  const std::string jpeg = jpeg_of(colourful());
  for (const double share : {0.1, 0.5, 0.9}) {
    const auto cut = [&](const std::string& whole) {
      return refusal(whole.substr(0, static_cast<std::size_t>(share * static_cast<double>(whole.size()))));
    };
    EXPECT_EQ(cut(png).rfind("it: is a damaged PNG; copy it again", 0), 0U) << cut(png);
    EXPECT_EQ(cut(jpeg).rfind("it: is a damaged JPEG; copy it again", 0), 0U) << cut(jpeg);
  }
}

TEST(ImageFile, APngWithAWrongChecksumIsRefused) {
  std::string png = encode_png(colourful());
  const std::size_t data = png.find("IDAT");
  ASSERT_NE(data, std::string::npos);
  png[data + 20] = static_cast<char>(png[data + 20] ^ 1);
  EXPECT_EQ(refusal(png).rfind("it: is a damaged PNG", 0), 0U) << refusal(png);
}

TEST(ImageFile, DamagedFilesNeverCrash) {
  std::mt19937 random(7);
  int refused = 0;
  for (const std::string& whole : {encode_png(colourful()), jpeg_of(colourful())}) {
    for (int i = 0; i < 1500; ++i) {
      std::string bytes = whole;
      for (auto k = 1 + random() % 4; k > 0; --k) bytes[random() % bytes.size()] = static_cast<char>(random() % 256);
      try {
        const cv::Mat image = decode_image(bytes, "it");
        EXPECT_EQ(image.type(), CV_8UC3);
      } catch (const SegmentProblem&) {
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 1500) << "a PNG has checksums everywhere";
}

TEST(ImageFile, MissingFilesAndFoldersAreTold) {
  EXPECT_THROW((void)read_image("/nowhere.png"), SegmentProblem);
  EXPECT_THROW((void)read_image(std::filesystem::temp_directory_path().string()), SegmentProblem);
}

}  // namespace
}  // namespace fencepost::host
