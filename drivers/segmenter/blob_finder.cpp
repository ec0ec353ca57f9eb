#include "drivers/segmenter/blob_finder.hpp"

#include <algorithm>

#include "drivers/serial/largest_first.hpp"
#include "hal/base/check.hpp"

namespace fencepost::segmenter {
namespace {

/// Pixels between two intervals; 0 where they touch or overlap.
int gap_between(int a1, int a2, int b1, int b2) { return std::max({0, b1 - a2 - 1, a1 - b2 - 1}); }

/// In tenths of a pixel, half away from zero.
base::Pixels1 mean(std::uint64_t sum, std::uint64_t count) {
  return {static_cast<std::int32_t>((2 * base::Pixels1::kPerUnit * sum + count) / (2 * count))};
}

}  // namespace

void BlobFinder::begin() {
  for (Row& row : rows_) {
    row.runs.clear();
    row.regions.clear();
  }
  closed_.clear();
  v_ = 0;
}

void BlobFinder::add_row(std::span<const std::uint8_t> labels) {
  FENCEPOST_CHECK(labels.size() <= kMaxWidth && static_cast<std::size_t>(v_) < kMaxHeight);
  take_row(labels);
  ++v_;
}

void BlobFinder::take_row(std::span<const std::uint8_t> labels) {
  Row& above = rows_[current_];
  current_ = 1 - current_;
  Row& row = rows_[current_];
  row.runs.clear();
  row.regions.clear();
  for (std::size_t u = 0; u < labels.size();) {
    const std::uint8_t signature = labels[u];
    const std::size_t first = u;
    while (u < labels.size() && labels[u] == signature) ++u;
    if (signature == 0) continue;
    (void)row.runs.push_back({signature, static_cast<std::int16_t>(first), static_cast<std::int16_t>(u - 1), kNone});
  }
  connect(above, row);
}

void BlobFinder::connect(Row& above, Row& row) {
  for (std::size_t i = 0; i < above.regions.size(); ++i) {
    parent_[i] = static_cast<std::uint16_t>(i);
    below_[i] = kNone;
  }
  join_above(above, row);
  for (Run& run : row.runs) {
    const std::uint16_t root = run.region == kNone ? kNone : root_of(run.region);
    run.region = root == kNone ? kNone : below_[root];
    if (run.region == kNone) {
      run.region = static_cast<std::uint16_t>(row.regions.size());
      (void)row.regions.push_back(root == kNone ? Region{run.signature, run.first, v_, run.last, v_}
                                                : above.regions[root]);
      if (root != kNone) below_[root] = run.region;
    }
    const auto pixels = static_cast<std::uint32_t>(run.last - run.first + 1);
    const auto ends = static_cast<std::uint32_t>(run.first + run.last);
    absorb(row.regions[run.region], {run.signature, run.first, v_, run.last, v_, pixels, ends * pixels / 2,
                                     static_cast<std::uint32_t>(v_) * pixels});
  }
  for (std::size_t i = 0; i < above.regions.size(); ++i) {
    if (parent_[i] == i && below_[i] == kNone) close(above.regions[i]);
  }
}

/// Each run gets one of the regions above that it touches; those that one run touches are one.
void BlobFinder::join_above(Row& above, Row& row) {
  std::size_t next = 0;
  for (Run& run : row.runs) {
    // A run above that ends before this one can touch no later one either; one that reaches beyond it may.
    while (next < above.runs.size() && above.runs[next].last + 1 < run.first) ++next;
    for (std::size_t i = next; i < above.runs.size() && above.runs[i].first <= run.last + 1; ++i) {
      const Run& other = above.runs[i];
      if (other.signature != run.signature) continue;
      run.region == kNone ? static_cast<void>(run.region = other.region) : unite(above, run.region, other.region);
    }
  }
}

std::uint16_t BlobFinder::root_of(std::uint16_t region) {
  while (parent_[region] != region) region = parent_[region] = parent_[parent_[region]];
  return region;
}

void BlobFinder::unite(Row& above, std::uint16_t a, std::uint16_t b) {
  const std::uint16_t first = root_of(a);
  const std::uint16_t second = root_of(b);
  if (first == second) return;
  parent_[second] = first;
  absorb(above.regions[first], above.regions[second]);
}

void BlobFinder::absorb(Region& into, const Region& other) {
  into.x1 = std::min(into.x1, other.x1);
  into.y1 = std::min(into.y1, other.y1);
  into.x2 = std::max(into.x2, other.x2);
  into.y2 = std::max(into.y2, other.y2);
  into.pixels += other.pixels;
  into.sum_u += other.sum_u;
  into.sum_v += other.sum_v;
}

void BlobFinder::close(const Region& region) {
  if (region.pixels < rules_.min_pixels) return;
  if (closed_.push_back(region)) return;
  ++dropped_;
  Region* const smallest = std::min_element(closed_.begin(), closed_.end(),
                                            [](const Region& a, const Region& b) { return a.pixels < b.pixels; });
  if (smallest->pixels < region.pixels) *smallest = region;
}

bool BlobFinder::belong_together(const Region& a, const Region& b) const {
  return a.signature == b.signature && gap_between(a.x1, a.x2, b.x1, b.x2) <= rules_.max_gap &&
         gap_between(a.y1, a.y2, b.y1, b.y2) <= rules_.max_gap;
}

/// Until no two belong together: in whatever order, the same boxes remain.
void BlobFinder::merge_near() {
  for (std::size_t i = 1; i < closed_.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (!belong_together(closed_[i], closed_[k])) continue;
      absorb(closed_[k], closed_[i]);
      closed_.erase_at(i);
      i = 0;  // larger now, it may reach any other
      break;
    }
  }
}

sensor::BlobFrame BlobFinder::finish() {
  take_row({});  // closes what reaches the last row
  merge_near();
  sensor::BlobFrame frame;
  for (const Region& region : closed_) {
    sensor::Blob blob;
    blob.signature = region.signature;
    blob.x1 = region.x1;
    blob.y1 = region.y1;
    blob.x2 = region.x2;
    blob.y2 = region.y2;
    blob.cx = mean(region.sum_u, region.pixels);
    blob.cy = mean(region.sum_v, region.pixels);
    blob.pixels = region.pixels;
    if (!serial::insert_largest_first(frame, blob)) ++dropped_;
  }
  begin();
  return frame;
}

}  // namespace fencepost::segmenter
