#include "host/simulate/render.hpp"

#include <algorithm>
#include <limits>

namespace fencepost::host {

void PixelBox::include(int u, int v) {
  if (empty()) {
    *this = {u, v, u, v};
    return;
  }
  x1 = std::min(x1, u);
  y1 = std::min(y1, v);
  x2 = std::max(x2, u);
  y2 = std::max(y2, v);
}

LabelImage::LabelImage(int width, int height) : width_(width), height_(height) {
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  labels_.assign(pixels, kNothing);
  depths_.assign(pixels, std::numeric_limits<double>::infinity());
}

void LabelImage::clear(std::size_t objects) {
  for (int v = touched_.y1; v <= touched_.y2; ++v) {
    const std::size_t begin = index(touched_.x1, v);
    const std::size_t count = static_cast<std::size_t>(touched_.x2 - touched_.x1 + 1);
    std::fill_n(labels_.begin() + static_cast<std::ptrdiff_t>(begin), count, kNothing);
    std::fill_n(depths_.begin() + static_cast<std::ptrdiff_t>(begin), count, std::numeric_limits<double>::infinity());
  }
  touched_ = {};
  alone_.assign(objects, PixelBox{});
}

void LabelImage::render(const std::vector<SceneObject>& objects, const PixelRays& rays, const CameraPose& camera) {
  clear(objects.size());
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const Prism prism(objects[i], camera);
    if (prism.behind()) continue;
    label_ = objects[i].trained ? static_cast<std::int16_t>(i) : kNothing;
    if (rays.separable()) {
      draw_by_columns(i, prism, rays);
    } else {
      draw_by_pixels(i, prism, rays);
    }
    if (alone_[i].empty()) continue;
    touched_.include(alone_[i].x1, alone_[i].y1);
    touched_.include(alone_[i].x2, alone_[i].y2);
  }
}

void LabelImage::draw_pixel(std::size_t object, const Prism& prism, int u, int v, double rise) {
  for (const Stretch& stretch : stretches_) {
    const double hit = prism.first_hit(stretch, rise);
    if (hit < 0) continue;
    alone_[object].include(u, v);
    const std::size_t pixel = index(u, v);
    if (hit < depths_[pixel]) {
      depths_[pixel] = hit;
      labels_[pixel] = label_;
    }
    return;
  }
}

void LabelImage::draw_by_columns(std::size_t object, const Prism& prism, const PixelRays& rays) {
  // Rows run downwards: rise falls.
  int top = 0;
  while (top < height_ && rays.rise(0, top) > prism.rise_max()) ++top;
  int bottom = height_ - 1;
  while (bottom >= top && rays.rise(0, bottom) < prism.rise_min()) --bottom;
  for (int u = 0; u < width_; ++u) {
    const double across = rays.across(u, 0);
    if (across < prism.across_min() || across > prism.across_max()) continue;
    prism.stretches(across, stretches_);
    if (stretches_.empty()) continue;
    for (int v = top; v <= bottom; ++v) draw_pixel(object, prism, u, v, rays.rise(0, v));
  }
}

void LabelImage::draw_by_pixels(std::size_t object, const Prism& prism, const PixelRays& rays) {
  int left = 0;
  int right = width_ - 1;
  const auto misses = [&](int u) {
    const PixelRays::Range& range = rays.across_of_column(u);
    return range.low > prism.across_max() || range.high < prism.across_min();
  };
  while (left <= right && misses(left)) ++left;
  while (right >= left && misses(right)) --right;
  for (int v = 0; v < height_; ++v) {
    const PixelRays::Range& range = rays.rise_of_row(v);
    if (range.low > prism.rise_max() || range.high < prism.rise_min()) continue;
    for (int u = left; u <= right; ++u) {
      if (!rays.exists(u, v)) continue;
      const double across = rays.across(u, v);
      const double rise = rays.rise(u, v);
      if (across < prism.across_min() || across > prism.across_max()) continue;
      if (rise < prism.rise_min() || rise > prism.rise_max()) continue;
      prism.stretches(across, stretches_);
      draw_pixel(object, prism, u, v, rise);
    }
  }
}

}  // namespace fencepost::host
