// A picture in memory.
#pragma once

#include <cstddef>
#include <vector>

#include "hal/sensor/blob_frame.hpp"

namespace fencepost::host {

/// Rows from the top.
struct RgbPicture {
  int width = 0;
  int height = 0;
  std::vector<sensor::Rgb> pixels;

  [[nodiscard]] sensor::Rgb at(int u, int v) const {
    return pixels[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u)];
  }
};

}  // namespace fencepost::host
