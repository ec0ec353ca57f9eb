#include "firmware/console/top_view.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/console/sentence.hpp"
#include "hal/base/trig.hpp"

namespace fencepost::console {
namespace {

// Millimetres a column; the coarsest shows the whole range of positions, +-1000 m.
constexpr std::array<std::int32_t, 16> kScales = {20,  30,   40,   50,   100,   150,   200,   300,
                                                  500, 1000, 2000, 5000, 10000, 20000, 50000, 100000};
constexpr std::int32_t kRim = 1;           // empty characters around the contents
constexpr std::int32_t kTickRows = 5;      // between two ticks
constexpr std::int32_t kTickColumns = 10;  // between two ticks
constexpr std::int32_t kSixteenths = 16;
constexpr std::int64_t kTurn = 6'283'185;  // microradians

std::int32_t nearest_multiple(std::int32_t value, std::int32_t of) {
  return static_cast<std::int32_t>(divide_rounded(value, of));
}
bool carries_tick(std::int32_t index, std::int32_t every) { return index % every == 0; }

base::Metres metres_of(std::int32_t mm) { return {mm * 10}; }

}  // namespace

void MapExtent::include(MapMillimetres place, std::int32_t radius) {
  low_ = {std::min(low_.x, place.x - radius), std::min(low_.y, place.y - radius)};
  high_ = {std::max(high_.x, place.x + radius), std::max(high_.y, place.y + radius)};
}

TopView TopView::of(const MapExtent& extent, MapMillimetres robot, std::int32_t heading_urad) {
  constexpr auto kRowsInside = static_cast<std::int32_t>(kRows) - 1 - 2 * kRim;
  constexpr auto kColumnsInside = static_cast<std::int32_t>(kColumns) - 1 - 2 * kRim;
  TopView view;
  while (view.scale + 1U < kScales.size() &&
         (extent.height() > kRowsInside * view.row_mm() || extent.width() > kColumnsInside * view.column_mm())) {
    ++view.scale;
  }
  const std::int32_t middle_row = nearest_multiple(extent.low().x + extent.height() / 2, view.row_mm());
  const std::int32_t middle_column = nearest_multiple(extent.low().y + extent.width() / 2, view.column_mm());
  view.top = middle_row + static_cast<std::int32_t>(kRows) / 2;
  view.left = middle_column + static_cast<std::int32_t>(kColumns) / 2;
  view.robot_row = static_cast<std::uint8_t>(view.row_of(robot.x));
  view.robot_column = static_cast<std::uint8_t>(view.column_of(robot.y));
  const std::int64_t turned = divide_rounded(static_cast<std::int64_t>(heading_urad) * kSixteenths, kTurn);
  view.heading = static_cast<std::uint8_t>(((turned % kSixteenths) + kSixteenths) % kSixteenths);
  return view;
}

std::int32_t TopView::column_mm() const { return kScales[scale]; }
std::int32_t TopView::row_of(std::int32_t x) const { return top - nearest_multiple(x, row_mm()); }
std::int32_t TopView::column_of(std::int32_t y) const { return left - nearest_multiple(y, column_mm()); }

TopViewRow::TopViewRow(const TopView& view, std::size_t row) : view_(view), row_(row) { cells_.fill(' '); }

void TopViewRow::mark(std::int32_t column, char c) {
  if (column < 0 || column >= static_cast<std::int32_t>(cells_.size())) return;
  cells_[static_cast<std::size_t>(column)] = c;
}

void TopViewRow::point(MapMillimetres place, char letter) {
  if (view_.row_of(place.x) == static_cast<std::int32_t>(row_)) mark(view_.column_of(place.y), letter);
}

void TopViewRow::bar(std::int32_t low, std::int32_t high, char letter) {
  const std::int32_t last = view_.column_of(low);
  for (std::int32_t column = view_.column_of(high); column <= last; ++column) mark(column, letter);
}

void TopViewRow::disc(MapMillimetres center, std::int32_t radius, char letter) {
  point(center, letter);
  const auto away = static_cast<float>(x() - center.x);
  const auto r = static_cast<float>(radius);
  if (std::fabs(away) > r) return;
  const auto half = static_cast<std::int32_t>(std::sqrt(r * r - away * away));
  bar(center.y - half, center.y + half, letter);
}

void TopViewRow::robot() {
  constexpr int kDots = 3;
  const base::SinCos heading = base::sincos_urad(view_.heading * kTurn / kSixteenths);
  const auto row = static_cast<std::int32_t>(row_);
  const auto rounded = [](float value) { return static_cast<std::int32_t>(value < 0 ? value - 0.5F : value + 0.5F); };
  for (int i = 1; i <= kDots; ++i) {
    const auto away = static_cast<float>(i);
    if (view_.robot_row - rounded(away * heading.cos) != row) continue;
    mark(view_.robot_column - rounded(2 * away * heading.sin), '.');
  }
  if (view_.robot_row == row_) mark(view_.robot_column, robot_arrow(view_));
}

std::size_t TopViewRow::write(std::span<char> out) const {
  const std::int32_t index = view_.top - static_cast<std::int32_t>(row_);
  Sentence s(out);
  if (carries_tick(index, kTickRows)) s.metres_to(TopView::kMargin - 2, metres_of(index * view_.row_mm()));
  s.pad_to(TopView::kMargin - 1).put(carries_tick(index, kTickRows) ? "+" : "|");
  std::size_t used = cells_.size();
  while (used > 0 && cells_[used - 1] == ' ') --used;
  return s.put({cells_.data(), used}).end();
}

char robot_arrow(const TopView& view) {
  constexpr char kArrows[] = {'^', '<', 'v', '>'};
  return kArrows[((view.heading + 2U) / 4U) % 4U];
}

std::size_t write_map_title(const TopView& view, std::span<char> out) {
  Sentence s(out);
  s.put("x m     from above, y to the left; a row is ").metres(metres_of(view.row_mm()));
  return s.put(" m, a column ").metres(metres_of(view.column_mm())).put(" m").end();
}

std::size_t write_ticks(const TopView& view, std::span<char> out) {
  Sentence s(out);
  s.pad_to(TopView::kMargin - 1).put("+");
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(TopView::kColumns); ++i) {
    s.put(carries_tick(view.left - i, kTickColumns) ? "+" : "-");
  }
  return s.end();
}

std::size_t write_tick_numbers(const TopView& view, std::span<char> out) {
  constexpr std::size_t kHalfNumber = 3;
  constexpr std::size_t kNumber = 8;  // characters of the longest, -1000.00
  Sentence s(out);
  s.put("    y m");
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(TopView::kColumns); ++i) {
    const std::size_t column = TopView::kMargin + static_cast<std::size_t>(i);
    const bool room = column > s.column() + kHalfNumber && column + kNumber <= TopView::kMargin + TopView::kColumns;
    if (!carries_tick(view.left - i, kTickColumns) || !room) continue;
    s.pad_to(column - kHalfNumber + 1).metres(metres_of((view.left - i) * view.column_mm()));
  }
  return s.end();
}

}  // namespace fencepost::console
