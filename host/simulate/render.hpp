// Which object each pixel shows: exact rays, nearest surface wins.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host/simulate/optics.hpp"
#include "host/simulate/pixel_box.hpp"
#include "host/simulate/prism.hpp"
#include "host/simulate/silhouette.hpp"

namespace fencepost::host {

/// One image of object indices, -1 where nothing is. Reused from frame to frame. Pixels are drawn only of objects that
/// are in front of others or behind them, or nearly so; of the rest the silhouette has everything.
class LabelImage {
 public:
  static constexpr std::int16_t kNothing = -1;

  LabelImage(int width, int height);

  /// Draws the objects as seen from `camera`; one that is not trained shows nothing, and hides what is behind it. Cost
  /// without pitch and distortion: as Silhouette's, and about 2 ns a pixel where an object is drawn.
  void render(const std::vector<SceneObject>& objects, const PixelRays& rays, const CameraPose& camera);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] std::int16_t at(int u, int v) const;
  /// The same of the drawn objects alone.
  [[nodiscard]] std::int16_t drawn(int u, int v) const { return labels_[index(u, v)]; }
  /// Distance ahead of the surface that a pixel of a drawn object shows, m.
  [[nodiscard]] double depth(int u, int v) const { return depths_[index(u, v)]; }
  /// Everything that is drawn lies in here.
  [[nodiscard]] const PixelBox& touched() const { return touched_; }
  /// Trained objects that are not drawn, ascending: each is one piece that touches no other.
  [[nodiscard]] const std::vector<std::size_t>& apart() const { return apart_; }
  [[nodiscard]] const Silhouette& silhouette(std::size_t object) const { return silhouettes_[object]; }
  /// Box of the object's pixels as if it stood alone: shows what occlusion removed.
  [[nodiscard]] const PixelBox& alone(std::size_t object) const { return alone_[object]; }

 private:
  [[nodiscard]] std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v) * stride_ + static_cast<std::size_t>(u);
  }
  void clear(std::size_t objects);
  /// The object's silhouette is whole, and nothing else is beside it.
  [[nodiscard]] bool stands_apart(std::size_t object) const;
  void draw(std::size_t object, const Prism& prism, const PixelRays& rays);
  void draw_by_columns(std::size_t object, const Prism& prism, const PixelRays& rays);
  void draw_by_pixels(std::size_t object, const Prism& prism, const PixelRays& rays);
  void draw_runs(std::size_t object, const Prism& prism, const PixelRays& rays);
  void draw_pixel(std::size_t object, const Prism& prism, std::span<const Stretch> stretches, int u, int v,
                  double rise);
  void show(std::size_t pixel, double hit);

  /// A cache line of depths: columns are drawn, and rows of 320 would all meet in an eighth of a cache.
  static constexpr std::size_t kBesideRow = 8;

  int width_;
  int height_;
  std::size_t stride_;  ///< pixels from row to row
  std::vector<std::int16_t> labels_;
  std::vector<double> depths_;
  std::vector<PixelBox> alone_;
  std::vector<Silhouette> silhouettes_;  ///< of all objects, without pitch and distortion
  std::vector<std::size_t> in_view_;     ///< those whose bounds are not empty: a few of thousands
  std::vector<std::size_t> apart_;
  std::vector<Stretch> stretches_;
  std::int16_t label_ = kNothing;  ///< of the object that is drawn
  PixelBox touched_;
};

}  // namespace fencepost::host
