// One picture of the map, taken at one moment and painted row by row later.
#pragma once

#include <cstddef>
#include <cstdint>

#include "firmware/view/figure.hpp"
#include "firmware/view/palette.hpp"
#include "firmware/view/shapes.hpp"
#include "firmware/view/window.hpp"
#include "hal/base/fixed.hpp"

namespace fencepost::view {

/// Map and grid, without anything on it.
void paint_ground(const Window& window, Row& row);

template <std::size_t N>
class Picture {
 public:
  void begin(const Window& window) {
    window_ = window;
    figures_.clear();
    labels_.clear();
    boxes_.clear();
    robot_ = {};
  }
  [[nodiscard]] const Window& window() const { return window_; }

  void add(const Figure& figure) { static_cast<void>(figures_.push_back(figure)); }
  void add(const Label& label) { static_cast<void>(labels_.push_back(label)); }
  void add(const Box& box) { static_cast<void>(boxes_.push_back(box)); }
  void put_robot(const Polygon& robot) { robot_ = robot; }

  void paint(Row& row) const {
    paint_ground(window_, row);
    for (const Figure& figure : figures_) figure.paint(row);
    robot_.paint_inside(row, kRobot);
    for (const Figure& figure : figures_) figure.letter.paint(row);
    row.fill(Window::kSide, INT32_MAX, kSide);
    for (const Box& box : boxes_) box.paint(row);
    for (const Label& label : labels_) label.paint(row);
  }

 private:
  static constexpr std::size_t kLabels = N + 8;
  static constexpr std::size_t kBoxes = N + 2;

  Window window_;
  Polygon robot_;
  base::FixedVector<Figure, N> figures_;
  base::FixedVector<Label, kLabels> labels_;
  base::FixedVector<Box, kBoxes> boxes_;
};

}  // namespace fencepost::view
