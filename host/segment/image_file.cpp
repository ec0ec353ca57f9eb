#include "host/segment/image_file.hpp"

#include <png.h>
#include <turbojpeg.h>

#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace fencepost::host {

namespace {

constexpr const char* kDamaged = "copy it again, or take its line out of the table of poses";

void check_size(std::int64_t width, std::int64_t height, const std::string& name) {
  constexpr std::int64_t kLongest = 32'767;      // px, the stream's pixel range
  constexpr std::int64_t kMaxPixels = 64 << 20;  // a damaged header must not allocate all memory
  if (width < 2 || height < 2 || width > kLongest || height > kLongest || width * height > kMaxPixels) {
    throw SegmentProblem{name, "is " + std::to_string(width) + " x " + std::to_string(height) + " px",
                         "scale it to between 2 px and 32767 px a side, 64 million px at most"};
  }
}

cv::Mat decode_png(std::string_view bytes, const std::string& name) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  const std::unique_ptr<png_image, decltype(&png_image_free)> guard(&png, &png_image_free);
  if (png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) == 0) {
    throw SegmentProblem{name, "is a damaged PNG", kDamaged};
  }
  check_size(png.width, png.height, name);
  png.format = PNG_FORMAT_BGR;
  cv::Mat image(static_cast<int>(png.height), static_cast<int>(png.width), CV_8UC3);
  const png_color white{255, 255, 255};
  const int done = png_image_finish_read(&png, &white, image.data, static_cast<png_int_32>(image.step[0]), nullptr);
  if (done == 0) {
    throw SegmentProblem{name, "is a damaged PNG", kDamaged};
  }
  return image;
}

cv::Mat decode_jpeg(std::string_view bytes, const std::string& name) {
  const std::unique_ptr<void, decltype(&tjDestroy)> decoder(tjInitDecompress(), &tjDestroy);
  const std::vector<unsigned char> data(bytes.begin(), bytes.end());
  const auto fail = [&] { throw SegmentProblem{name, "is a damaged JPEG", kDamaged}; };
  int width = 0;
  int height = 0;
  int subsampling = 0;
  int space = 0;
  if (tjDecompressHeader3(decoder.get(), data.data(), data.size(), &width, &height, &subsampling, &space) != 0 ||
      width < 1)
    fail();
  check_size(width, height, name);
  cv::Mat image(height, width, CV_8UC3);
  const int pitch = static_cast<int>(image.step[0]);
  if (tjDecompress2(decoder.get(), data.data(), data.size(), image.data, width, pitch, height, TJPF_BGR,
                    TJFLAG_ACCURATEDCT) != 0) {
    fail();
  }
  return image;
}

}  // namespace

cv::Mat decode_image(std::string_view bytes, const std::string& name) {
  if (bytes.substr(0, 8) == "\x89PNG\r\n\x1a\n") return decode_png(bytes, name);
  if (bytes.substr(0, 3) == "\xff\xd8\xff") return decode_jpeg(bytes, name);
  if (bytes.empty()) throw SegmentProblem{name, "is empty", kDamaged};
  throw SegmentProblem{name, "is neither PNG nor JPEG", "convert it to PNG"};
}

cv::Mat read_image(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream all;
  if (file) all << file.rdbuf();
  // An empty file sets failbit on `all` only; a folder opens but cannot be read.
  if (!file || file.bad()) throw SegmentProblem{path, "cannot be read", "check the name and the permissions"};
  return decode_image(all.str(), path);
}

std::string encode_png(const cv::Mat& image) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.cols);
  png.height = static_cast<png_uint_32>(image.rows);
  png.format = PNG_FORMAT_BGR;
  const auto stride = static_cast<png_int_32>(image.step[0]);
  png_alloc_size_t size = 0;
  std::string bytes;
  if (png_image_write_to_memory(&png, nullptr, &size, 0, image.data, stride, nullptr) != 0) {
    bytes.resize(size);
    if (png_image_write_to_memory(&png, bytes.data(), &size, 0, image.data, stride, nullptr) != 0) return bytes;
  }
  throw std::runtime_error(std::string("PNG: ") + png.message);
}

}  // namespace fencepost::host
