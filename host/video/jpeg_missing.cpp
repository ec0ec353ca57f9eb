// Replaces jpeg.cpp where the build had no libjpeg-turbo.
#include "host/video/jpeg.hpp"

namespace fencepost::host {

struct JpegDecoder::Library {};

JpegDecoder::JpegDecoder() = default;
JpegDecoder::~JpegDecoder() = default;

std::string JpegDecoder::missing() {
  return "this fencepost was built without libjpeg-turbo and reads no JPEG; install libturbojpeg0-dev and build again";
}

base::Result<bus::Picture> JpegDecoder::decode(std::span<const std::uint8_t> /*bytes*/) {
  return base::Error::kBadInput;
}

std::string encode_jpeg(const RgbPicture& /*picture*/) { return {}; }

}  // namespace fencepost::host
