// One picture for training: of a file, or of a camera once it has got used to the light.
#pragma once

#include <string>

#include "hal/bus/picture_source.hpp"
#include "hal/linux/opened.hpp"
#include "hal/linux/v4l2.hpp"
#include "host/video/rgb_picture.hpp"

namespace fencepost::host {

/// A whole picture of a source, whatever its layout.
RgbPicture to_rgb(const bus::Picture& picture);

/// A JPEG file, or the first picture of a film. errors: a sentence
linux::Opened<RgbPicture> read_picture(const std::string& path);

/// A camera's picture after two seconds, in which it sets exposure and white balance. errors: a sentence
linux::Opened<RgbPicture> take_picture(const linux::V4l2Settings& settings);

}  // namespace fencepost::host
