#include "host/simulate/silhouette.hpp"

#include <algorithm>

namespace fencepost::host {

void Silhouette::find(const Prism& prism, const PixelRays& rays) {
  whole_ = true;
  box_ = {};
  columns_.clear();
  bound(prism, rays);
  if (bounds_.empty()) return;
  find_stretches(prism, rays);
  wall_begin_ = wall_end_ = bounds_.y1;
  for (int u = bounds_.x1; u <= bounds_.x2; ++u) {
    const std::span<const Stretch> met = stretches(u);
    if (met.size() > 1) whole_ = false;
    if (!whole_) return;
    if (!met.empty()) add(u, run_of(prism, rays, met.front()));
  }
}

// The columns and rows whose rays can meet it at all.
void Silhouette::bound(const Prism& prism, const PixelRays& rays) {
  bounds_ = {};
  int left = 0;
  int right = rays.width() - 1;
  while (left <= right && rays.across(left, 0) < prism.across_min()) ++left;
  while (right >= left && rays.across(right, 0) > prism.across_max()) --right;
  // Rows run downwards: rise falls.
  int top = 0;
  int bottom = rays.height() - 1;
  while (top <= bottom && rays.rise(0, top) > prism.rise_max()) ++top;
  while (bottom >= top && rays.rise(0, bottom) < prism.rise_min()) --bottom;
  if (left <= right && top <= bottom) bounds_ = {left, top, right, bottom};
}

// An edge begins where the one before it ends: its first column is not far.
void Silhouette::find_stretches(const Prism& prism, const PixelRays& rays) {
  const auto across = [&](int u) { return rays.across(u, 0); };
  const auto columns = static_cast<std::size_t>(bounds_.x2 - bounds_.x1 + 1);
  crossings_.clear();
  stretch_begin_.assign(columns + 1, 0);
  int from = bounds_.x1;
  for (const Prism::Edge& edge : prism.edges()) {
    while (from > bounds_.x1 && across(from - 1) >= edge.low) --from;
    while (from <= bounds_.x2 && across(from) < edge.low) ++from;
    for (int u = from; u <= bounds_.x2 && across(u) < edge.high; ++u) {
      crossings_.push_back({u, edge.crossing(across(u))});
    }
  }
  std::sort(crossings_.begin(), crossings_.end(), [](const Crossing& a, const Crossing& b) {
    return a.column != b.column ? a.column < b.column : a.distance < b.distance;
  });
  stretches_.clear();
  for (std::size_t i = 0; i + 1 < crossings_.size(); ++i) {
    if (crossings_[i].column != crossings_[i + 1].column) continue;
    stretches_.push_back({crossings_[i].distance, crossings_[i + 1].distance});
    ++stretch_begin_[static_cast<std::size_t>(crossings_[i].column - bounds_.x1) + 1];
    ++i;
  }
  for (std::size_t c = 0; c < columns; ++c) stretch_begin_[c + 1] += stretch_begin_[c];
}

bool Silhouette::covers(int u, int v) const {
  if (!box_.contains(u, v)) return false;
  const ColumnRun& run = columns_[static_cast<std::size_t>(u - box_.x1)];
  return v >= run.first && v <= run.last;
}

// Downwards along the stretch a ray meets the lid, the wall, the underside, or some of them. Its height at the wall,
// and its distance at a lid, rise or fall with the row, rounding included. So each is one run of rows, and its nearest
// pixel is beside the wall.
ColumnRun Silhouette::run_of(const Prism& prism, const PixelRays& rays, const Stretch& stretch) {
  const int top = bounds_.y1;
  const int bottom = bounds_.y2;
  const auto height = [&](int v) { return rays.rise(0, v) * stretch.enter; };
  const auto hit = [&](int v) { return prism.first_hit(stretch, rays.rise(0, v)); };
  int begin = wall_begin_;
  while (begin > top && height(begin - 1) <= prism.top()) --begin;
  while (begin <= bottom && height(begin) > prism.top()) ++begin;
  int end = std::max(begin, wall_end_);
  while (end > begin && height(end - 1) < prism.bottom()) --end;
  while (end <= bottom && height(end) >= prism.bottom()) ++end;
  wall_begin_ = begin;
  wall_end_ = end;
  ColumnRun run{begin, begin, end, end - 1, stretch.enter};
  bool found = !run.empty();
  const auto include = [&](double distance) {
    run.nearest = found ? std::min(run.nearest, distance) : distance;
    found = true;
  };
  if (begin > top && hit(begin - 1) >= 0) include(hit(begin - 1));
  while (run.first > top && hit(run.first - 1) >= 0) --run.first;
  if (end <= bottom && hit(end) >= 0) include(hit(end));
  while (run.last < bottom && hit(run.last + 1) >= 0) ++run.last;
  return run;
}

void Silhouette::add(int u, const ColumnRun& run) {
  if (run.empty()) return;
  if (!columns_.empty()) {
    const ColumnRun& before = columns_.back();
    const bool touches = u == box_.x2 + 1 && run.first <= before.last + 1 && run.last >= before.first - 1;
    if (!touches) whole_ = false;
  }
  box_.include(u, run.first);
  box_.include(u, run.last);
  columns_.push_back(run);
}

}  // namespace fencepost::host
