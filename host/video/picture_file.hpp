// One picture for training: of a file, or of a camera once it has got used to the light.
#pragma once

#include <string>
#include <vector>

#include "hal/bus/picture_source.hpp"
#include "hal/linux/opened.hpp"
#include "hal/linux/v4l2.hpp"
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

/// A whole picture of a source, whatever its layout.
RgbPicture to_rgb(const bus::Picture& picture);

/// A JPEG file, or the first picture of a film. errors: a sentence
linux::Opened<RgbPicture> read_picture(const std::string& path);

/// A camera's picture after two seconds, in which it sets exposure and white balance. errors: a sentence
linux::Opened<RgbPicture> take_picture(const linux::V4l2Settings& settings);

}  // namespace fencepost::host
