// JPEG pictures to rows of red, green, blue.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "hal/base/result.hpp"
#include "hal/bus/picture_source.hpp"
#include "host/video/picture_file.hpp"

namespace fencepost::host {

class JpegDecoder {
 public:
  JpegDecoder();
  ~JpegDecoder();
  JpegDecoder(const JpegDecoder&) = delete;
  JpegDecoder& operator=(const JpegDecoder&) = delete;

  /// Whether this build can decode; else what to install, a sentence.
  static std::string missing();

  /// The picture, kRgb, borrowed until the next call. errors: kBadInput: damaged, cut off, or of more than 64 million
  /// pixels
  base::Result<bus::Picture> decode(std::span<const std::uint8_t> bytes);

 private:
  struct Library;
  base::Result<bus::Picture> decode_by_library(std::span<const std::uint8_t> bytes);

  std::unique_ptr<Library> library_;
  std::vector<std::uint8_t> rgb_;
};

/// A JPEG file without much loss; empty where this build has no JPEG.
std::string encode_jpeg(const RgbPicture& picture);

}  // namespace fencepost::host
