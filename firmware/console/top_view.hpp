// The map from above as characters: x up, y to the left, a character twice as high as wide.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace fencepost::console {

/// Map frame, whole millimetres.
struct MapMillimetres {
  std::int32_t x = 0;
  std::int32_t y = 0;
};

/// The part of the map that is to be seen.
class MapExtent {
 public:
  void include(MapMillimetres place, std::int32_t radius);
  [[nodiscard]] MapMillimetres low() const { return low_; }
  [[nodiscard]] MapMillimetres high() const { return high_; }
  [[nodiscard]] std::int32_t height() const { return high_.x - low_.x; }  ///< along x
  [[nodiscard]] std::int32_t width() const { return high_.y - low_.y; }

 private:
  MapMillimetres low_{INT32_MAX, INT32_MAX};
  MapMillimetres high_{INT32_MIN, INT32_MIN};
};

/// Which part, at what scale, with the robot where it was when the drawing began.
struct TopView {
  static constexpr std::size_t kRows = 18;  ///< with title, edge, numbers and legend one screen
  static constexpr std::size_t kColumns = 71;
  static constexpr std::size_t kMargin = 8;  ///< characters left of the columns

  std::int32_t top = 0;   ///< of row 0, in rows from the map's origin
  std::int32_t left = 0;  ///< of column 0, in columns
  std::uint8_t scale = 0;
  std::uint8_t robot_row = 0;
  std::uint8_t robot_column = 0;
  std::uint8_t heading = 0;  ///< in sixteenths of a turn

  /// The finest scale that shows all of `extent` (which holds the robot).
  static TopView of(const MapExtent& extent, MapMillimetres robot, std::int32_t heading_urad);

  [[nodiscard]] std::int32_t column_mm() const;
  [[nodiscard]] std::int32_t row_mm() const { return 2 * column_mm(); }
  [[nodiscard]] std::int32_t row_of(std::int32_t x) const;
  [[nodiscard]] std::int32_t column_of(std::int32_t y) const;
};

/// One row of the drawing. What is drawn later is on top.
class TopViewRow {
 public:
  TopViewRow(const TopView& view, std::size_t row);
  /// Map x of its middle, mm.
  [[nodiscard]] std::int32_t x() const { return (view_.top - static_cast<std::int32_t>(row_)) * view_.row_mm(); }
  /// One character, if it is in this row.
  void point(MapMillimetres place, char letter);
  /// From y to y.
  void bar(std::int32_t low, std::int32_t high, char letter);
  /// Nothing smaller than one character.
  void disc(MapMillimetres center, std::int32_t radius, char letter);
  /// An arrow, and dots in the direction of the heading.
  void robot();
  /// With the scale at its left end and the line's end.
  std::size_t write(std::span<char> out) const;

 private:
  void mark(std::int32_t column, char c);

  const TopView& view_;
  std::size_t row_;
  std::array<char, TopView::kColumns> cells_{};
};

/// '^', '<', 'v' or '>', the nearest to the heading.
char robot_arrow(const TopView& view);
/// The title: the size of a row and of a column.
std::size_t write_map_title(const TopView& view, std::span<char> out);
/// The lower edge with ticks, and their numbers.
std::size_t write_ticks(const TopView& view, std::span<char> out);
std::size_t write_tick_numbers(const TopView& view, std::span<char> out);

/// The letter of the object in this slot of the map's table.
constexpr char letter_of(std::size_t slot) {
  constexpr char kLetters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";
  return slot < sizeof kLetters - 1 ? kLetters[slot] : '+';
}

}  // namespace fencepost::console
