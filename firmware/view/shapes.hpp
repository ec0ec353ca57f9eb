// The shapes of a picture. They are painted row by row, for there is no room for a second picture beside the screen's.
#pragma once

#include <cstdint>
#include <span>

#include "hal/base/fixed.hpp"

namespace fencepost::view {

/// Pixels; x to the right, y down. Kept within kFarthest, so that products fit 32 bits.
struct Point {
  std::int16_t x = 0;
  std::int16_t y = 0;
  friend constexpr bool operator==(Point, Point) = default;
};
inline constexpr std::int32_t kFarthest = 4000;
constexpr Point point_at(std::int32_t x, std::int32_t y) {
  const auto near = [](std::int32_t value) {
    return static_cast<std::int16_t>(value < -kFarthest ? -kFarthest : value > kFarthest ? kFarthest : value);
  };
  return {near(x), near(y)};
}

/// One row of the screen. What is painted later is on top; what lies outside is left out.
class Row {
 public:
  Row(std::span<std::uint8_t> pixels, std::int32_t y) : pixels_(pixels), y_(y) {}
  [[nodiscard]] std::int32_t y() const { return y_; }
  /// From `left` to `right`, both included.
  void fill(std::int32_t left, std::int32_t right, std::uint8_t colour);

 private:
  std::span<std::uint8_t> pixels_;
  std::int32_t y_;
};

struct Box {
  std::int16_t left = 0;
  std::int16_t top = 0;
  std::int16_t right = 0;   ///< included
  std::int16_t bottom = 0;  ///< included
  std::uint8_t colour = 0;
  void paint(Row& row) const;
};

struct Disc {
  Point center;
  std::int16_t radius = 0;
  std::uint8_t colour = 0;
  void paint(Row& row) const;
};

/// A convex polygon. Corners beyond its capacity are left out; the caller has to thin them out before.
class Polygon {
 public:
  static constexpr std::size_t kMax = 24;

  void add(Point corner);
  [[nodiscard]] bool empty() const { return corners_.empty(); }
  /// Its edges, a pixel wide.
  void paint_edges(Row& row, std::uint8_t colour) const;
  void paint_inside(Row& row, std::uint8_t colour) const;

 private:
  base::FixedVector<Point, kMax> corners_;
  std::int16_t top_ = INT16_MAX;
  std::int16_t bottom_ = INT16_MIN;
};

/// One line of text; what does not fit into it is cut off.
struct Label {
  static constexpr std::size_t kMax = 16;

  Point place;            ///< of the first letter's upper left pixel
  std::uint8_t size = 1;  ///< pixels of the screen a pixel of the letter
  std::uint8_t colour = 0;
  base::FixedString<kMax> text;
  void paint(Row& row) const;
};

}  // namespace fencepost::view
