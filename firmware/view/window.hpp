// Which part of the map the screen shows: x up, y to the left, at one of a few scales.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "firmware/console/top_view.hpp"
#include "firmware/view/shapes.hpp"

namespace fencepost::view {

struct Scale {
  std::int32_t mm;       ///< a pixel
  std::int32_t grid_mm;  ///< between two lines of the grid; a multiple of mm
};
inline constexpr std::array<Scale, 7> kScales = {
    {{2, 100}, {5, 100}, {10, 500}, {20, 500}, {50, 1000}, {100, 5000}, {200, 5000}}};

struct Window {
  static constexpr std::int32_t kSide = 160;  ///< pixels, both ways; its left upper corner is the screen's
  static constexpr std::int32_t kRim = 12;    ///< kept free around what is to be seen

  console::MapMillimetres middle;
  std::uint8_t scale = 1;

  [[nodiscard]] std::int32_t mm() const { return kScales[scale].mm; }
  [[nodiscard]] std::int32_t grid_mm() const { return kScales[scale].grid_mm; }
  [[nodiscard]] Point pixel_of(console::MapMillimetres place) const {
    return point_at(kSide / 2 - pixels(place.y - middle.y), kSide / 2 - pixels(place.x - middle.x));
  }

 private:
  // To the nearest.
  [[nodiscard]] std::int32_t pixels(std::int32_t millimetres) const {
    const std::int32_t half = mm() / 2;
    return (millimetres + (millimetres < 0 ? -half : half)) / mm();
  }
};

/// The window that shows all of `extent` at the finest scale. It is a whole number of pixels from the origin, so that
/// nothing jitters.
inline Window window_of(const console::MapExtent& extent) {
  Window window;
  const std::int32_t larger = std::max(extent.width(), extent.height());
  while (window.scale + 1U < kScales.size() && larger > (Window::kSide - 2 * Window::kRim) * window.mm()) {
    ++window.scale;
  }
  const auto rounded = [&](std::int32_t value) { return value / (10 * window.mm()) * (10 * window.mm()); };
  window.middle = {rounded(extent.low().x + extent.height() / 2), rounded(extent.low().y + extent.width() / 2)};
  return window;
}

}  // namespace fencepost::view
