#include "firmware/view/shapes.hpp"

#include <algorithm>

#include "firmware/view/font.hpp"

namespace fencepost::view {
namespace {

struct Reach {
  std::int32_t left = INT32_MAX;
  std::int32_t right = INT32_MIN;

  void include(Reach other) {
    left = std::min(left, other.left);
    right = std::max(right, other.right);
  }
};

// The x at `half_y` half pixels of the edge from the upper end `a` to `b`, clamped to its ends.
std::int32_t x_at(Point a, Point b, std::int32_t half_y) {
  const std::int32_t height = 2 * (b.y - a.y);
  const std::int32_t along = std::clamp<std::int32_t>(half_y - 2 * a.y, 0, height);
  return a.x + (b.x - a.x) * along / height;
}

// The columns that an edge takes in a row: from half a pixel above its middle to half a pixel below.
Reach reach_of(Point a, Point b, std::int32_t y) {
  if (a.y > b.y) std::swap(a, b);
  if (y < a.y || y > b.y) return {};
  if (a.y == b.y) return {std::min(a.x, b.x), std::max(a.x, b.x)};
  const std::int32_t upper = x_at(a, b, 2 * y - 1);
  const std::int32_t lower = x_at(a, b, 2 * y + 1);
  return {std::min(upper, lower), std::max(upper, lower)};
}

// The largest whole number whose square is not above.
std::int32_t whole_root(std::int32_t square) {
  std::int32_t root = 0;
  for (std::int32_t bit = 1 << 12; bit > 0; bit >>= 1) {
    if ((root + bit) * (root + bit) <= square) root += bit;
  }
  return root;
}

}  // namespace

void Row::fill(std::int32_t left, std::int32_t right, std::uint8_t colour) {
  const std::int32_t last = std::min(right, static_cast<std::int32_t>(pixels_.size()) - 1);
  for (std::int32_t x = std::max<std::int32_t>(left, 0); x <= last; ++x) pixels_[static_cast<std::size_t>(x)] = colour;
}

void Box::paint(Row& row) const {
  if (row.y() >= top && row.y() <= bottom) row.fill(left, right, colour);
}

void Disc::paint(Row& row) const {
  const std::int32_t away = row.y() - center.y;
  const std::int32_t inside = radius * radius - away * away;
  if (away < -radius || away > radius || inside < 0) return;
  const std::int32_t half = whole_root(inside);
  row.fill(center.x - half, center.x + half, colour);
}

void Polygon::add(Point corner) {
  if (corners_.full() || (!corners_.empty() && corners_[corners_.size() - 1U] == corner)) return;
  static_cast<void>(corners_.push_back(corner));
  top_ = std::min(top_, corner.y);
  bottom_ = std::max(bottom_, corner.y);
}

void Polygon::paint_edges(Row& row, std::uint8_t colour) const {
  if (row.y() < top_ || row.y() > bottom_) return;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Reach reach = reach_of(corners_[i], corners_[i + 1 < corners_.size() ? i + 1 : 0], row.y());
    row.fill(reach.left, reach.right, colour);
  }
}

void Polygon::paint_inside(Row& row, std::uint8_t colour) const {
  if (row.y() < top_ || row.y() > bottom_) return;
  Reach all;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    all.include(reach_of(corners_[i], corners_[i + 1 < corners_.size() ? i + 1 : 0], row.y()));
  }
  row.fill(all.left, all.right, colour);
}

void Label::paint(Row& row) const {
  const std::int32_t below = row.y() - place.y;
  if (below < 0 || below >= size * static_cast<std::int32_t>(kLetterHeight)) return;
  std::int32_t x = place.x;
  for (const char letter : text.view()) {
    const std::uint8_t bits = letter_row(letter, static_cast<std::size_t>(below / size));
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(kLetterWidth); ++i) {
      if (((bits >> (kLetterWidth - 1 - static_cast<std::size_t>(i))) & 1U) == 0) continue;
      row.fill(x + i * size, x + i * size + size - 1, colour);
    }
    x += size * static_cast<std::int32_t>(kLetterPitch);
  }
}

}  // namespace fencepost::view
