#include "host/segment/regions.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "host/segment/connected.hpp"

namespace fencepost::host {

namespace {

void add_pixel(ImageRegion& region, int u, int v, const cv::Vec3b& colour) {
  if (region.pixels == 0) region = {region.label, u, v, u, v};
  region.x1 = std::min(region.x1, u);
  region.x2 = std::max(region.x2, u);
  region.y2 = v;  // rows come in order
  ++region.pixels;
  region.sum_u += u;
  region.sum_v += v;
  region.sum_bgr += cv::Vec3d(colour[0], colour[1], colour[2]);
}

std::vector<ImageRegion> all_parts(const cv::Mat& labels, const cv::Mat& image) {
  const std::uint8_t* label = labels.ptr();
  const auto same = [&](std::size_t a, std::size_t b) { return label[a] == label[b]; };
  const std::vector<int> part = connected_parts(labels.rows, labels.cols, true, same);
  std::vector<ImageRegion> regions;
  for (std::size_t i = 0; i < part.size(); ++i) {
    const auto number = static_cast<std::size_t>(part[i]);
    if (number >= regions.size()) regions.resize(number + 1);
    if (label[i] == 0) continue;
    regions[number].label = label[i];
    const int u = static_cast<int>(i) % labels.cols;
    const int v = static_cast<int>(i) / labels.cols;
    add_pixel(regions[number], u, v, image.at<cv::Vec3b>(v, u));
  }
  std::erase_if(regions, [](const ImageRegion& region) { return region.label == 0; });
  return regions;
}

/// The free interval between two, inclusive; nothing where they overlap or touch.
std::optional<std::pair<int, int>> gap_between(int a1, int a2, int b1, int b2) {
  if (a2 + 1 < b1) return std::pair{a2 + 1, b1 - 1};
  if (b2 + 1 < a1) return std::pair{b2 + 1, a1 - 1};
  return std::nullopt;
}

int width(const std::optional<std::pair<int, int>>& gap) { return gap ? gap->second - gap->first + 1 : 0; }

/// The gap between the two along one axis, or their common part where there is none.
std::pair<int, int> span_between(int a1, int a2, int b1, int b2) {
  return gap_between(a1, a2, b1, b2).value_or(std::pair{std::max(a1, b1), std::min(a2, b2)});
}

/// More than half of the rectangle between the two is of another signature: an object occludes it.
bool is_filled(const ImageRegion& a, const ImageRegion& b, const cv::Mat& labels) {
  const auto [left, right] = span_between(a.x1, a.x2, b.x1, b.x2);
  const auto [top, bottom] = span_between(a.y1, a.y2, b.y1, b.y2);
  int others = 0;
  for (int v = top; v <= bottom; ++v) {
    for (int u = left; u <= right; ++u) {
      const std::uint8_t label = labels.at<std::uint8_t>(v, u);
      if (label != 0 && label != a.label) ++others;
    }
  }
  return 2 * others > (right - left + 1) * (bottom - top + 1);
}

bool belong_together(const ImageRegion& a, const ImageRegion& b, const cv::Mat& labels, int max_gap) {
  if (a.label != b.label) return false;
  const auto across = gap_between(a.x1, a.x2, b.x1, b.x2);
  const auto down = gap_between(a.y1, a.y2, b.y1, b.y2);
  return width(across) <= max_gap && width(down) <= max_gap && !is_filled(a, b, labels);
}

void absorb(ImageRegion& into, const ImageRegion& other) {
  into.x1 = std::min(into.x1, other.x1);
  into.y1 = std::min(into.y1, other.y1);
  into.x2 = std::max(into.x2, other.x2);
  into.y2 = std::max(into.y2, other.y2);
  into.pixels += other.pixels;
  into.sum_u += other.sum_u;
  into.sum_v += other.sum_v;
  into.sum_bgr += other.sum_bgr;
}

/// Joins regions that belong together until none do; the number of joints.
std::size_t merge(std::vector<ImageRegion>& regions, const cv::Mat& labels, int max_gap) {
  std::size_t merged = 0;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    for (std::size_t k = i + 1; k < regions.size(); ++k) {
      if (!belong_together(regions[i], regions[k], labels, max_gap)) continue;
      absorb(regions[i], regions[k]);
      regions.erase(regions.begin() + static_cast<std::ptrdiff_t>(k));
      ++merged;
      k = i;  // larger now, it may reach others
    }
  }
  return merged;
}

/// Ends near the border onto it.
void snap(ImageRegion& region, const cv::Size& size, int border) {
  if (region.x1 <= border) region.x1 = 0;
  if (region.y1 <= border) region.y1 = 0;
  if (region.x2 >= size.width - 1 - border) region.x2 = size.width - 1;
  if (region.y2 >= size.height - 1 - border) region.y2 = size.height - 1;
}

}  // namespace

Regions find_regions(const cv::Mat& labels, const cv::Mat& image, const RegionRules& rules) {
  Regions regions;
  regions.kept = all_parts(labels, image);
  const auto least = static_cast<std::uint32_t>(std::max(1, rules.min_pixels));
  regions.small = std::erase_if(regions.kept, [&](const ImageRegion& region) { return region.pixels < least; });
  regions.merged = merge(regions.kept, labels, rules.max_gap);
  for (ImageRegion& region : regions.kept) snap(region, labels.size(), rules.border);
  std::sort(regions.kept.begin(), regions.kept.end(), [](const ImageRegion& a, const ImageRegion& b) {
    return std::tuple(b.pixels, a.label, a.x1, a.y1) < std::tuple(a.pixels, b.label, b.x1, b.y1);
  });
  return regions;
}

sensor::Blob to_blob(const ImageRegion& region) {
  sensor::Blob blob;
  blob.x1 = static_cast<std::int16_t>(region.x1);
  blob.y1 = static_cast<std::int16_t>(region.y1);
  blob.x2 = static_cast<std::int16_t>(region.x2);
  blob.y2 = static_cast<std::int16_t>(region.y2);
  blob.cx = base::Pixels1::nearest(region.sum_u / region.pixels);
  blob.cy = base::Pixels1::nearest(region.sum_v / region.pixels);
  blob.pixels = region.pixels;
  const auto mean = [&](int channel) {
    return static_cast<std::uint8_t>(std::lround(region.sum_bgr[channel] / region.pixels));
  };
  blob.rgb = sensor::Rgb{mean(2), mean(1), mean(0)};
  return blob;
}

}  // namespace fencepost::host
