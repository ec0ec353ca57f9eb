#include "host/metrics/perimeter.hpp"

#include <algorithm>
#include <cmath>

namespace fencepost::host {
namespace {

/// Less than this of an image's view of the perimeter (m) is rounding.
constexpr double kNoLength = 1e-12;

double common(const std::vector<Stretch01>& a, const std::vector<Stretch01>& b) {
  double sum = 0;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    sum += std::max(0.0, std::min(a[i].end, b[j].end) - std::max(a[i].begin, b[j].begin));
    (a[i].end < b[j].end ? i : j) += 1;
  }
  return sum;
}

}  // namespace

PerimeterPart::PerimeterPart(const LinearRing& outline) : stretches_(outline.size()) {
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Point a = outline[i];
    const Point b = outline[(i + 1) % outline.size()];
    edge_lengths_.push_back(std::hypot(b.x - a.x, b.y - a.y));
  }
}

void PerimeterPart::add(std::size_t edge, Stretch01 stretch) {
  stretch = {std::clamp(stretch.begin, 0.0, 1.0), std::clamp(stretch.end, 0.0, 1.0)};
  if (!(stretch.begin < stretch.end)) return;
  std::vector<Stretch01>& all = stretches_[edge];
  const auto first = std::find_if(all.begin(), all.end(), [&](Stretch01 s) { return s.end >= stretch.begin; });
  auto last = first;
  for (; last != all.end() && last->begin <= stretch.end; ++last) {
    stretch = {std::min(stretch.begin, last->begin), std::max(stretch.end, last->end)};
  }
  all.insert(all.erase(first, last), stretch);
}

void PerimeterPart::add(const PerimeterPart& other) {
  for (std::size_t edge = 0; edge < other.stretches_.size(); ++edge) {
    for (const Stretch01& stretch : other.stretches_[edge]) add(edge, stretch);
  }
}

double PerimeterPart::length() const { return common_length(*this); }

double PerimeterPart::whole() const {
  double sum = 0;
  for (const double length : edge_lengths_) sum += length;
  return sum;
}

double PerimeterPart::share() const {
  const double all = whole();
  return all > 0 ? length() / all : 0;
}

double PerimeterPart::common_length(const PerimeterPart& other) const {
  double sum = 0;
  for (std::size_t edge = 0; edge < edge_lengths_.size(); ++edge) {
    sum += edge_lengths_[edge] * common(stretches_[edge], other.stretches_[edge]);
  }
  return sum;
}

std::optional<double> ViewSet::novelty(const PerimeterPart& image) const {
  const double shown = image.length();
  if (shown < kNoLength) return std::nullopt;
  return std::clamp(1 - image.common_length(seen_) / shown, 0.0, 1.0);
}

}  // namespace fencepost::host
