#include "host/monitor/screen.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/monitor/map_part.hpp"

namespace fencepost::host::monitor {
namespace {

constexpr std::size_t kWide = 72;        ///< from this many columns on the objects are beside the map
constexpr std::size_t kPanel = 28;       ///< columns of theirs
constexpr std::size_t kRoomForAll = 12;  ///< rows from which all parts are shown

Style level_style(record::AlertLevel level) {
  switch (level) {
    case record::AlertLevel::kClear: return {.ink = Ink::kBlack, .paper = Ink::kGreen};
    case record::AlertLevel::kNotice: return {.ink = Ink::kBlack, .paper = Ink::kCyan};
    case record::AlertLevel::kWarn: return {.ink = Ink::kBlack, .paper = Ink::kYellow, .bold = true};
    case record::AlertLevel::kStop: return {.ink = Ink::kWhite, .paper = Ink::kRed, .bold = true};
    case record::AlertLevel::kBlind: return {.ink = Ink::kWhite, .paper = Ink::kMagenta, .bold = true};
  }
  return {};
}

void draw_head(Cells& cells, const Believed& believed, const Caption& caption) {
  const std::size_t end = cells.size().columns;
  const record::AlertLevel level = believed.level();
  const std::string word = " " + word_of(level) + " ";
  const std::size_t room = end > word.size() + 1 ? end - word.size() - 1 : 0;
  std::string text = fmt::format("{:.1f} s", believed.t());
  if (!caption.state.empty()) text += "  " + caption.state;
  // The name is what gives way.
  const std::size_t for_name = room > text.size() + 2 ? room - text.size() - 2 : 0;
  const std::string name = length(caption.name) <= for_name ? caption.name : std::string();
  cells.put(0, 0, name.empty() ? text : name + "  " + text, {.bold = true});
  cells.fill(0, room, end, {});
  cells.put_right(0, 0, end, word, level_style(level));
}

struct Row {
  double distance;
  const record::ObjectReport* object;
};

/// The nearest first.
std::vector<Row> rows_of(const Believed& believed) {
  const Pose pose = believed.pose().value_or(Pose{});
  std::vector<Row> rows;
  for (const auto& [id, object] : believed.objects()) {
    const double away = std::hypot(object.x.to_double() - pose.x, object.y.to_double() - pose.y);
    rows.push_back({std::max(0.0, away - object.radius.to_double()), &object});
  }
  std::ranges::stable_sort(rows, {}, &Row::distance);
  return rows;
}

/// "12 l": degrees to the left or right of the robot's nose.
std::string side_of(const record::ObjectReport& object, const Pose& pose) {
  const double bearing = std::atan2(object.y.to_double() - pose.y, object.x.to_double() - pose.x) - pose.heading;
  const double turn = std::remainder(bearing, 2 * std::numbers::pi) * 180 / std::numbers::pi;
  return fmt::format("{:3.0f} {}", std::abs(turn), turn >= 0 ? 'l' : 'r');
}

void draw_objects(Cells& cells, Part part, const Believed& believed) {
  const Pose pose = believed.pose().value_or(Pose{});
  const std::vector<Row> rows = rows_of(believed);
  std::size_t row = part.top;
  for (const Row& one : rows) {
    const bool last = row + 1 == part.bottom && &one != &rows.back();
    if (row >= part.bottom) break;
    if (last) {
      const auto left_out = static_cast<std::size_t>(&rows.back() - &one) + 1;
      cells.put(row, part.left, fmt::format("and {} more", left_out), {.dim = true});
      break;
    }
    const record::ObjectReport& object = *one.object;
    const Style style = style_of(object, believed);
    const std::string numbers = fmt::format(" {:5.2f} m {}", one.distance, side_of(object, pose));
    cells.put(row, part.left,
              fmt::format("{} {} {}", letter_of(object.id), object.id, believed.name_of(object.id, object.signature)),
              style);
    const std::size_t at = part.right > numbers.size() + part.left ? part.right - numbers.size() : part.left;
    cells.put(row, at, numbers, style);
    ++row;
  }
  if (rows.empty() && part.bottom > part.top) cells.put(part.top, part.left, "no objects yet", {.dim = true});
}

/// The last ones, the newest lowest.
void draw_said(Cells& cells, std::size_t top, std::size_t bottom, const Believed& believed) {
  const auto& said = believed.said();
  const std::size_t shown = std::min(bottom - top, said.size());
  for (std::size_t i = 0; i < shown; ++i) {
    const Said& line = said[said.size() - shown + i];
    const std::size_t column = cells.put(top + i, 0, fmt::format("{:8.2f} ", line.t), {.dim = true});
    const bool loud = line.level && *line.level >= record::AlertLevel::kWarn;
    cells.put(top + i, column, line.text, {.ink = loud ? Ink::kRed : Ink::kDefault, .bold = loud});
  }
}

Style link_style(sensor::LinkState state) {
  return sensor::works(state) ? Style{} : Style{.ink = Ink::kRed, .bold = true};
}

void draw_links(Cells& cells, std::size_t row, const Believed& believed, const Caption& caption) {
  std::size_t column = 0;
  const auto add = [&](const std::string& text, Style style) {
    column = cells.put(row, column, (column > 0 ? "  " : "") + text, style);
  };
  if (const auto& beat = believed.beat()) {
    add("camera " + std::string(sensor::name(beat->camera)), link_style(beat->camera));
    add("odometry " + std::string(sensor::name(beat->odometry)), link_style(beat->odometry));
  }
  for (const auto& [device, link] : believed.links()) {
    const bool told = believed.beat() && (device == "camera" || device == "odometry");
    if (!told) add(device + " " + std::string(sensor::name(link.state)), link_style(link.state));
  }
  add(fmt::format("{:.0f} frames/s", believed.frame_rate()), {});
  const std::size_t end = cells.size().columns;
  if (column + 2 + length(caption.keys) <= end) cells.put_right(row, 0, end, caption.keys, {.dim = true});
}

}  // namespace

std::string word_of(record::AlertLevel level) {
  std::string word(record::name(level));
  for (char& c : word) c = static_cast<char>(c - 'a' + 'A');
  return word;
}

Cells screen_of(const Believed& believed, const Caption& caption, Size size) {
  Cells cells(size);
  if (size.rows == 0 || size.columns == 0) return cells;
  draw_head(cells, believed, caption);
  if (size.rows == 1) return cells;
  if (size.rows < kRoomForAll) {
    const std::size_t said = size.rows - 1 > 3 ? 2 : 1;
    draw_map(cells, {1, 0, size.rows - said, size.columns}, believed);
    draw_said(cells, size.rows - said, size.rows, believed);
    return cells;
  }
  const std::size_t links = size.rows - 1;
  const std::size_t said = size.rows >= 20 ? links - 4 : links - 2;
  draw_links(cells, links, believed, caption);
  draw_said(cells, said, links, believed);
  if (size.columns >= kWide) {
    draw_map(cells, {1, 0, said, size.columns - kPanel - 1}, believed);
    draw_objects(cells, {1, size.columns - kPanel, said, size.columns}, believed);
  } else {
    const std::size_t below = std::min<std::size_t>(believed.objects().size() + 1, said > 12 ? 4 : 2);
    draw_map(cells, {1, 0, said - below, size.columns}, believed);
    draw_objects(cells, {said - below, 0, said, size.columns}, believed);
  }
  return cells;
}

}  // namespace fencepost::host::monitor
