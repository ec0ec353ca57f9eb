// Image files: PNG and JPEG to pixels, pixels to PNG.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <string_view>

#include "host/segment/problem.hpp"

namespace fencepost::host {

/// 8-bit blue, green, red. Alpha is put on white, 16 bits become 8, grey becomes colour; EXIF's rotation is not
/// followed. `name` is for messages. errors: SegmentProblem: neither PNG nor JPEG, damaged or cut off, more than 32767
/// px a side
cv::Mat decode_image(std::string_view bytes, const std::string& name);

/// The same from a file. errors: SegmentProblem: cannot be read, and as above
cv::Mat read_image(const std::string& path);

/// 8-bit blue, green, red to the bytes of a PNG file.
std::string encode_png(const cv::Mat& image);

}  // namespace fencepost::host
