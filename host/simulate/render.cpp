#include "host/simulate/render.hpp"

#include <algorithm>
#include <limits>

namespace fencepost::host {

LabelImage::LabelImage(int width, int height)
    : width_(width), height_(height), stride_(static_cast<std::size_t>(width) + kBesideRow) {
  const std::size_t pixels = stride_ * static_cast<std::size_t>(height);
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
  apart_.clear();
  in_view_.clear();
  silhouettes_.resize(std::max(silhouettes_.size(), objects));
}

std::int16_t LabelImage::at(int u, int v) const {
  for (const std::size_t object : apart_) {
    if (silhouettes_[object].covers(u, v)) return static_cast<std::int16_t>(object);
  }
  return drawn(u, v);
}

void LabelImage::render(const std::vector<SceneObject>& objects, const PixelRays& rays, const CameraPose& camera) {
  clear(objects.size());
  std::vector<Prism> prisms;
  prisms.reserve(objects.size());
  for (std::size_t i = 0; i < objects.size(); ++i) {
    prisms.emplace_back(objects[i], camera);
    if (!rays.separable()) continue;
    silhouettes_[i].find(prisms[i], rays);
    if (!silhouettes_[i].bounds().empty()) in_view_.push_back(i);
  }
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (prisms[i].behind()) continue;
    label_ = objects[i].trained ? static_cast<std::int16_t>(i) : kNothing;
    if (!rays.separable() || !stands_apart(i)) {
      draw(i, prisms[i], rays);
    } else {
      alone_[i] = silhouettes_[i].box();
      if (objects[i].trained && !alone_[i].empty()) apart_.push_back(i);
    }
  }
}

bool LabelImage::stands_apart(std::size_t object) const {
  if (!silhouettes_[object].whole()) return false;
  if (silhouettes_[object].box().empty()) return true;
  return std::none_of(in_view_.begin(), in_view_.end(), [&](std::size_t other) {
    return other != object && silhouettes_[other].bounds().touches(silhouettes_[object].box());
  });
}

void LabelImage::draw(std::size_t object, const Prism& prism, const PixelRays& rays) {
  if (rays.separable()) {
    draw_by_columns(object, prism, rays);
  } else {
    draw_by_pixels(object, prism, rays);
  }
  if (alone_[object].empty()) return;
  touched_.include(alone_[object].x1, alone_[object].y1);
  touched_.include(alone_[object].x2, alone_[object].y2);
}

void LabelImage::show(std::size_t pixel, double hit) {
  if (!(hit < depths_[pixel])) return;
  depths_[pixel] = hit;
  labels_[pixel] = label_;
}

void LabelImage::draw_pixel(std::size_t object, const Prism& prism, std::span<const Stretch> stretches, int u, int v,
                            double rise) {
  for (const Stretch& stretch : stretches) {
    const double hit = prism.first_hit(stretch, rise);
    if (hit < 0) continue;
    alone_[object].include(u, v);
    show(index(u, v), hit);
    return;
  }
}

void LabelImage::draw_by_columns(std::size_t object, const Prism& prism, const PixelRays& rays) {
  const Silhouette& silhouette = silhouettes_[object];
  if (silhouette.whole()) return draw_runs(object, prism, rays);
  const PixelBox& bounds = silhouette.bounds();
  for (int u = bounds.x1; u <= bounds.x2; ++u) {
    const std::span<const Stretch> stretches = silhouette.stretches(u);
    for (int v = bounds.y1; v <= bounds.y2 && !stretches.empty(); ++v) {
      draw_pixel(object, prism, stretches, u, v, rays.rise(0, v));
    }
  }
}

void LabelImage::draw_runs(std::size_t object, const Prism& prism, const PixelRays& rays) {
  const Silhouette& silhouette = silhouettes_[object];
  alone_[object] = silhouette.box();
  int u = silhouette.box().x1;
  for (const ColumnRun& run : silhouette.columns()) {
    const Stretch& stretch = silhouette.stretches(u).front();
    const auto show_top = [&](int begin, int end) {
      for (int v = begin; v < end; ++v) show(index(u, v), prism.first_hit(stretch, rays.rise(0, v)));
    };
    const int wall_begin = std::clamp(run.wall_begin, run.first, run.last + 1);
    const int wall_end = std::clamp(run.wall_end, wall_begin, run.last + 1);
    show_top(run.first, wall_begin);
    for (int v = wall_begin; v < wall_end; ++v) show(index(u, v), stretch.enter);
    show_top(wall_end, run.last + 1);
    ++u;
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
      draw_pixel(object, prism, stretches_, u, v, rise);
    }
  }
}

}  // namespace fencepost::host
