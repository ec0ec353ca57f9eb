// Rendered films of a robot's way: coloured blocks on a floor, a camera's noise, and light that changes.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "drivers/segmenter/camera.hpp"
#include "host/render/picture.hpp"
#include "host/render/regions.hpp"
#include "host/video/picture_file.hpp"

namespace fencepost::host::testing {

/// Gains of red, green and blue; 1: as rendered.
struct Light {
  double red = 1;
  double green = 1;
  double blue = 1;
};

/// A lamp that dims, a cloud that goes, flicker, and a white balance that wanders.
inline Light changing_light(double t) {
  double level = 1;
  if (t > 1) level = std::max(0.5, 1 - (t - 1) / 3);
  if (t > 3.5) level = std::max(0.9, 1.15 - (t - 3.5) / 4);
  level *= 1 + 0.05 * std::sin(19 * t);
  const double warmth = 0.06 * std::sin(1.3 * t);
  return {level * (1 + warmth), level, level * (1 - warmth)};
}

inline Light steady_light(double /*t*/) { return {}; }

/// It gets dark and warm.
inline Light evening_light(double t) {
  const double level = std::max(0.5, 1 - t / 12);
  const double warmth = 0.015 * t;
  return {level * (1 + warmth), level, level * (1 - warmth)};
}

/// A lamp is switched off and on again.
inline Light switched_light(double t) { return t > 2 && t < 4.5 ? Light{0.62, 0.65, 0.7} : Light{}; }

/// More and more than the camera can bear.
inline Light glaring_light(double t) { return {1 + t / 25, 1 + t / 25, 1 + t / 25}; }

inline Solid block(std::uint8_t signature, sensor::Rgb colour, double x, double y, double width) {
  const Polygon footprint{{{x, y - width / 2}, {x + 0.1, y - width / 2}, {x + 0.1, y + width / 2}, {x, y + width / 2}},
                          {}};
  return {{footprint}, 0, 0.2, signature, colour, signature};
}

struct TrueBox {
  std::uint8_t signature = 0;
  int x1 = 0;
  int y1 = 0;
  int x2 = 0;
  int y2 = 0;
  std::uint32_t pixels = 0;
};

class Studio {
 public:
  static constexpr double kRate = 10;     // pictures a second
  static constexpr double kSpeed = 0.25;  // m/s, along x

  explicit Studio(Light (*light)(double)) : light_(light), camera_(segmenter::kProfile) {
    camera_.mount.x = base::Metres::nearest(0.05);
    camera_.mount.z = base::Metres::nearest(0.12);
    camera_.mount.pitch = base::Radians{};
  }

  [[nodiscard]] const sensor::CameraIntrinsics& camera() const { return camera_; }
  static double x_at(double t) { return kSpeed * t; }

  /// As the camera sees it that stamps its picture at `t`.
  [[nodiscard]] Picture drawn(double t, PictureStyle style) const {
    const double exposed = t - camera_.latency.to_double();
    return draw_picture(solids_, {camera_, lens_at(camera_, {exposed, x_at(exposed), 0, 0}), 0, 1}, style);
  }

  [[nodiscard]] std::vector<TrueBox> truth(double t) const {
    const Picture flat = drawn(t, PictureStyle::kSegmented);
    std::vector<TrueBox> boxes;
    for (const Solid& solid : solids_) {
      TrueBox box{solid.signature, flat.width, flat.height, -1, -1};
      for (int v = 0; v < flat.height; ++v) {
        for (int u = 0; u < flat.width; ++u) {
          if (flat.at(u, v) != solid.colour) continue;
          box = {box.signature,       std::min(box.x1, u), std::min(box.y1, v),
                 std::max(box.x2, u), std::max(box.y2, v), box.pixels + 1};
        }
      }
      if (box.pixels > 0) boxes.push_back(box);
    }
    return boxes;
  }

  /// Y4M, 4:2:0, limited range.
  std::string film(int pictures) {
    std::string bytes = "YUV4MPEG2 W320 H240 F10:1 Ip C420jpeg\n";
    for (int i = 0; i < pictures; ++i) bytes += "FRAME\n" + planes(i / kRate);
    return bytes;
  }

 private:
  std::string planes(double t) {
    const Picture picture = drawn(t, PictureStyle::kShaded);
    const Light light = light_(t);
    std::normal_distribution<double> noise(0, 3);  // grey levels
    const auto width = static_cast<std::size_t>(picture.width);
    const auto height = static_cast<std::size_t>(picture.height);
    std::string luma;
    std::vector<double> u(width / 2 * (height / 2));
    std::vector<double> v(u.size());
    for (std::size_t row = 0; row < height; ++row) {
      for (std::size_t column = 0; column < width; ++column) {
        const sensor::Rgb rgb = picture.at(static_cast<int>(column), static_cast<int>(row));
        const auto seen = [&](std::uint8_t level, double gain) {
          return std::clamp(level * gain + noise(random_), 0.0, 255.0);
        };
        const double red = seen(rgb.red, light.red);
        const double green = seen(rgb.green, light.green);
        const double blue = seen(rgb.blue, light.blue);
        const double y = 0.299 * red + 0.587 * green + 0.114 * blue;
        luma += byte(16 + y * 219 / 255);
        const std::size_t at = row / 2 * (width / 2) + column / 2;
        u[at] += (blue - y) / 1.772 * 224 / 255 / 4;
        v[at] += (red - y) / 1.402 * 224 / 255 / 4;
      }
    }
    for (const double chroma : u) luma += byte(128 + chroma);
    for (const double chroma : v) luma += byte(128 + chroma);
    return luma;
  }
  static char byte(double value) {
    return static_cast<char>(static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L)));
  }

  Light (*light_)(double);
  sensor::CameraIntrinsics camera_;
  std::vector<Solid> solids_ = {block(1, {230, 110, 30}, 1.8, 0, 0.14), block(2, {40, 80, 190}, 2.0, 0.5, 0.16),
                                block(3, {60, 150, 60}, 1.6, -0.45, 0.12)};
  std::mt19937 random_{11};
};

}  // namespace fencepost::host::testing
