#include "host/video/picture_file.hpp"

#include <algorithm>
#include <cmath>

#include "hal/linux/wait.hpp"
#include "host/video/picture_port.hpp"

namespace fencepost::host {
namespace {

std::uint8_t level(double value) { return static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L)); }

/// ITU-R BT.601.
sensor::Rgb from_yuv(double y, double u, double v, bool full) {
  if (!full) {
    y = (y - 16) * 255 / 219;
    u = (u - 128) * 255 / 224;
    v = (v - 128) * 255 / 224;
  } else {
    u -= 128;
    v -= 128;
  }
  return {level(y + 1.402 * v), level(y - 0.344136 * u - 0.714136 * v), level(y + 1.772 * u)};
}

}  // namespace

RgbPicture to_rgb(const bus::Picture& picture) {
  RgbPicture rgb{picture.width, picture.height, {}};
  for (std::size_t v = 0; v < picture.height; ++v) {
    const std::uint8_t* const row = picture.bytes.data() + v * picture.stride;
    for (std::size_t u = 0; u < picture.width; ++u) {
      if (picture.layout == bus::PixelLayout::kRgb) {
        rgb.pixels.push_back({row[3 * u], row[3 * u + 1], row[3 * u + 2]});
        continue;
      }
      const std::uint8_t* const pair = row + u / 2 * 4;
      rgb.pixels.push_back(
          from_yuv(pair[2 * (u % 2)], pair[1], pair[3], picture.layout == bus::PixelLayout::kYuyvFull));
    }
  }
  return rgb;
}

linux::Opened<RgbPicture> read_picture(const std::string& path) {
  linux::Opened<Film> film = Film::open(path);
  if (!film) return linux::Problem{film.problem()};
  const base::Result<bus::Picture> first = film->next();
  if (!first) return linux::Problem{"the film " + path + " has no whole picture; copy it again"};
  return to_rgb(*first);
}

linux::Opened<RgbPicture> take_picture(const linux::V4l2Settings& settings) {
  constexpr base::Duration kSettled = base::milliseconds(2'000);
  constexpr base::Duration kPatience = base::milliseconds(5'000);
  WebcamPort port([&settings] { return linux::V4l2::open(settings); });
  if (!port.try_open()) return linux::Problem{port.problem()};
  const linux::MonotonicClock clock;
  linux::WaitSet set;
  while (clock.now() < base::Time{} + kPatience && port.connected()) {
    set.clear();
    set.add_readable(port.descriptor());
    set.wait_until(clock, clock.now() + base::milliseconds(100));
    port.tend(clock.now());
    const base::Result<bus::Picture> picture = port.next();
    if (picture && clock.now() >= base::Time{} + kSettled) return to_rgb(*picture);
  }
  return linux::Problem{"the camera " + settings.path +
                        " sent no whole picture; check its cable, and that no other program has it"};
}

}  // namespace fencepost::host
