// Films and pictures as files of a test.
#pragma once

#include <vector>

#include "host/video/picture_file.hpp"
#include "tests/folder.hpp"

namespace fencepost::host::testing {

inline RgbPicture plain(int width, int height, sensor::Rgb rgb) {
  return {width, height, std::vector<sensor::Rgb>(static_cast<std::size_t>(width * height), rgb)};
}

inline void paint(RgbPicture& picture, int x1, int y1, int x2, int y2, sensor::Rgb rgb) {
  for (int v = y1; v <= y2; ++v) {
    for (int u = x1; u <= x2; ++u) picture.pixels[static_cast<std::size_t>(v * picture.width + u)] = rgb;
  }
}

}  // namespace fencepost::host::testing
