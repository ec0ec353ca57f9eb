#include "host/monitor/map_part.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <numbers>

namespace fencepost::host::monitor {
namespace {

constexpr double kSmallest = 0.5;  ///< m, each way around the robot
constexpr double kTallCells = 2;   ///< height of a cell over its width
constexpr double kLongestAgo = 3;  ///< s; an object not reported for longer is remembered, not seen

struct Bounds {
  Point low{HUGE_VAL, HUGE_VAL};
  Point high{-HUGE_VAL, -HUGE_VAL};
  void add(Point p, double radius) {
    low = {std::min(low.x, p.x - radius), std::min(low.y, p.y - radius)};
    high = {std::max(high.x, p.x + radius), std::max(high.y, p.y + radius)};
  }
};

/// One of `steps` times a power of ten, at least `least`.
double nice(double least, std::initializer_list<double> steps) {
  const double power = std::pow(10, std::floor(std::log10(least)));
  for (const double step : steps) {
    if (step * power >= least) return step * power;
  }
  return 10 * power;
}

class View {
 public:
  View(Part part, const Bounds& bounds) : part_(part) {
    const auto rows = static_cast<double>(part.bottom - part.top);
    const auto columns = static_cast<double>(part.right - part.left);
    // Steps keep the picture still while the robot moves.
    column_ = nice(std::max((bounds.high.y - bounds.low.y) / std::max(1.0, columns - 2),
                            (bounds.high.x - bounds.low.x) / (kTallCells * std::max(1.0, rows - 2))),
                   {1, 1.25, 1.5, 2, 2.5, 3, 4, 5, 6, 8});
    const auto snapped = [](double value, double step) { return std::round(value / step) * step; };
    middle_ = {snapped((bounds.low.x + bounds.high.x) / 2, kTallCells * column_),
               snapped((bounds.low.y + bounds.high.y) / 2, column_)};
  }

  [[nodiscard]] double column() const { return column_; }  ///< m
  [[nodiscard]] double row_at(double x) const {
    return static_cast<double>(part_.top + part_.bottom - 1) / 2 - (x - middle_.x) / (kTallCells * column_);
  }
  [[nodiscard]] double column_at(double y) const {
    return static_cast<double>(part_.left + part_.right - 1) / 2 - (y - middle_.y) / column_;
  }
  void mark(Cells& cells, Point p, char character, Style style) const {
    const double row = std::round(row_at(p.x));
    const double column = std::round(column_at(p.y));
    const bool inside = row >= static_cast<double>(part_.top) && row < static_cast<double>(part_.bottom) &&
                        column >= static_cast<double>(part_.left) && column < static_cast<double>(part_.right);
    if (inside) cells.mark(static_cast<std::size_t>(row), static_cast<std::size_t>(column), character, style);
  }
  void disc(Cells& cells, Point centre, double radius, char character, Style style) const {
    for (double x = centre.x - radius; x <= centre.x + radius; x += column_ / 2) {
      for (double y = centre.y - radius; y <= centre.y + radius; y += column_ / 2) {
        if (std::hypot(x - centre.x, y - centre.y) <= radius) mark(cells, {x, y}, character, style);
      }
    }
    mark(cells, centre, character, style);
  }

 private:
  Part part_;
  double column_ = 1;
  Point middle_;
};

Point place_of(const record::ObjectReport& object) { return {object.x.to_double(), object.y.to_double()}; }

Bounds bounds_of(const Believed& believed) {
  Bounds bounds;
  const Pose pose = believed.pose().value_or(Pose{});
  bounds.add({pose.x, pose.y}, kSmallest);
  for (const Point& p : believed.trail()) bounds.add(p, 0);
  for (const auto& [id, object] : believed.objects()) {
    if (object.state != record::ObjectState::kTentative) bounds.add(place_of(object), object.radius.to_double());
  }
  return bounds;
}

void draw_heading(Cells& cells, const View& view, const Pose& pose) {
  constexpr int kDots = 3;
  for (int i = 1; i <= kDots; ++i) {
    const double away = kTallCells * view.column() * i;
    view.mark(cells, {pose.x + away * std::cos(pose.heading), pose.y + away * std::sin(pose.heading)}, '.',
              {.bold = true});
  }
}

void draw_robot(Cells& cells, const View& view, const Pose& pose) {
  constexpr std::array kArrows = {'^', '<', 'v', '>'};
  const double quarters = std::round(pose.heading / (std::numbers::pi / 2));
  const auto arrow = static_cast<std::size_t>(((static_cast<long>(quarters) % 4) + 4) % 4);
  view.mark(cells, {pose.x, pose.y}, kArrows[arrow], {.bold = true});
}

void draw_scale(Cells& cells, Part part, const View& view) {
  constexpr double kShortest = 5;  // cells
  const double metres = nice(kShortest * view.column(), {1, 2, 5});
  const auto cells_long = static_cast<std::size_t>(std::lround(metres / view.column()));
  const std::string text = fmt::format("|{}| {:g} m", std::string(cells_long > 1 ? cells_long - 1 : 0, '-'), metres);
  if (text.size() < part.right - part.left) cells.put(part.bottom - 1, part.left, text, {.dim = true});
}

}  // namespace

Style style_of(const record::ObjectReport& object, const Believed& believed) {
  Style style;
  style.dim = object.state != record::ObjectState::kConfirmed || believed.t() - object.t.to_double() > kLongestAgo;
  const auto alert = believed.alerts().find(object.id);
  if (alert == believed.alerts().end()) return style;
  style.dim = false;
  style.bold = true;
  style.ink = alert->second.level == record::AlertLevel::kNotice ? Ink::kYellow : Ink::kRed;
  return style;
}

void draw_map(Cells& cells, Part part, const Believed& believed) {
  if (part.bottom <= part.top || part.right <= part.left) return;
  const View view(part, bounds_of(believed));
  draw_scale(cells, part, view);
  for (const Point& p : believed.trail()) view.mark(cells, p, '.', {.dim = true});
  const std::optional<Pose>& pose = believed.pose();
  if (pose) draw_heading(cells, view, *pose);
  for (const auto& [id, object] : believed.objects()) {
    view.disc(cells, place_of(object), object.radius.to_double(), letter_of(id), style_of(object, believed));
  }
  if (!pose) return;
  draw_robot(cells, view, *pose);
  const auto something = believed.alerts().find(record::kNoObject);
  if (something == believed.alerts().end() || !something->second.has_place()) return;
  const double direction = pose->heading + something->second.bearing.to_double();
  const double distance = something->second.distance.to_double();
  view.mark(cells, {pose->x + distance * std::cos(direction), pose->y + distance * std::sin(direction)}, '!',
            {.ink = Ink::kRed, .bold = true});
}

}  // namespace fencepost::host::monitor
