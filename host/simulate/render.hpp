// Which object each pixel shows: exact rays, nearest surface wins.
#pragma once

#include <cstdint>
#include <vector>

#include "host/simulate/optics.hpp"
#include "host/simulate/prism.hpp"

namespace fencepost::host {

/// Inclusive pixel box; empty when x1 > x2.
struct PixelBox {
  int x1 = 1;
  int y1 = 1;
  int x2 = 0;
  int y2 = 0;
  [[nodiscard]] bool empty() const { return x1 > x2; }
  void include(int u, int v);
};

/// One image of object indices, -1 where nothing is. Reused from frame to frame.
class LabelImage {
 public:
  static constexpr std::int16_t kNothing = -1;

  LabelImage(int width, int height);

  /// Draws the objects as seen from `camera`; one that is not trained shows nothing, and hides what is behind it. Cost:
  /// about 10 ns a covered pixel without pitch and distortion.
  void render(const std::vector<SceneObject>& objects, const PixelRays& rays, const CameraPose& camera);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] std::int16_t at(int u, int v) const { return labels_[index(u, v)]; }
  /// Distance ahead of the surface that the pixel shows, m.
  [[nodiscard]] double depth(int u, int v) const { return depths_[index(u, v)]; }
  /// Everything that is drawn lies in here.
  [[nodiscard]] const PixelBox& touched() const { return touched_; }
  /// Box of the object's pixels as if it stood alone: shows what occlusion removed.
  [[nodiscard]] const PixelBox& alone(std::size_t object) const { return alone_[object]; }

 private:
  [[nodiscard]] std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(u);
  }
  void clear(std::size_t objects);
  void draw_by_columns(std::size_t object, const Prism& prism, const PixelRays& rays);
  void draw_by_pixels(std::size_t object, const Prism& prism, const PixelRays& rays);
  void draw_pixel(std::size_t object, const Prism& prism, int u, int v, double rise);

  int width_;
  int height_;
  std::vector<std::int16_t> labels_;
  std::vector<double> depths_;
  std::vector<PixelBox> alone_;
  std::vector<Stretch> stretches_;
  std::int16_t label_ = kNothing;  ///< of the object that is drawn
  PixelBox touched_;
};

}  // namespace fencepost::host
