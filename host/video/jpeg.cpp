#include "host/video/jpeg.hpp"

#include <turbojpeg.h>

namespace fencepost::host {

struct JpegDecoder::Library {
  std::unique_ptr<void, decltype(&tjDestroy)> handle{tjInitDecompress(), &tjDestroy};
};

JpegDecoder::JpegDecoder() : library_(std::make_unique<Library>()) {}
JpegDecoder::~JpegDecoder() = default;

std::string JpegDecoder::missing() { return {}; }

base::Result<bus::Picture> JpegDecoder::decode(std::span<const std::uint8_t> bytes) {
  const base::Result<bus::Picture> picture = decode_by_library(bytes);
  // After a damaged header the library takes the next picture for the rest of this one.
  if (!picture) library_ = std::make_unique<Library>();
  return picture;
}

base::Result<bus::Picture> JpegDecoder::decode_by_library(std::span<const std::uint8_t> bytes) {
  constexpr std::int64_t kMaxPixels = 64 << 20;  // a damaged header must not allocate all memory
  constexpr int kMaxSide = 32'767;               // px, the stream's range
  int width = 0;
  int height = 0;
  int subsampling = 0;
  int space = 0;
  void* const handle = library_->handle.get();
  if (tjDecompressHeader3(handle, bytes.data(), bytes.size(), &width, &height, &subsampling, &space) != 0 ||
      width < 1 || height < 1 || width > kMaxSide || height > kMaxSide || std::int64_t{width} * height > kMaxPixels) {
    return base::Error::kBadInput;
  }
  const std::size_t stride = std::size_t{3} * static_cast<std::size_t>(width);
  rgb_.resize(stride * static_cast<std::size_t>(height));
  // A warning, such as of a picture that was cut off, is a failure too.
  if (tjDecompress2(handle, bytes.data(), bytes.size(), rgb_.data(), width, 0, height, TJPF_RGB, 0) != 0) {
    return base::Error::kBadInput;
  }
  return bus::Picture{
      bus::PixelLayout::kRgb, static_cast<std::uint16_t>(width), static_cast<std::uint16_t>(height), stride, rgb_, {}};
}

std::string encode_jpeg(const RgbPicture& picture) {
  constexpr int kQuality = 95;
  std::vector<std::uint8_t> bytes;
  for (const sensor::Rgb rgb : picture.pixels) bytes.insert(bytes.end(), {rgb.red, rgb.green, rgb.blue});
  const std::unique_ptr<void, decltype(&tjDestroy)> encoder(tjInitCompress(), &tjDestroy);
  unsigned char* out = nullptr;
  unsigned long size = 0;
  // Full chroma: the picture is for its colours.
  const int failed = tjCompress2(encoder.get(), bytes.data(), picture.width, 0, picture.height, TJPF_RGB, &out, &size,
                                 TJSAMP_444, kQuality, 0);
  const std::unique_ptr<unsigned char, decltype(&tjFree)> owner(out, &tjFree);
  return failed != 0 ? std::string() : std::string(out, out + size);
}

}  // namespace fencepost::host
