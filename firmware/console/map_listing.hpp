// `map`: the state of the map as a drawing, line by line.
#pragma once

#include <cstddef>
#include <span>

#include "firmware/console/map_shape.hpp"
#include "firmware/console/sentence.hpp"
#include "firmware/console/signatures.hpp"
#include "firmware/console/top_view.hpp"
#include "firmware/console/trail.hpp"

namespace fencepost::console {

/// Title, rows, lower edge, its numbers, legend.
inline constexpr std::size_t kMapLines = TopView::kRows + 4;

inline constexpr char kTrailMark = 'o';

/// The contents of the drawing: the slots of the map's table, the names of the signatures, and the trail.
template <class Profile>
struct MapContents {
  std::span<const recon::Object<Profile>> objects;
  std::span<const record::Signature> signatures;
  std::span<const TrailPlace> trail{};
};

template <class Profile>
TopView view_of(const MapContents<Profile>& map, const recon::MapPose& robot) {
  MapExtent extent;
  extent.include(millimetres(robot.position), 0);
  // The way here is shown, all of a long run would make the drawing coarse.
  constexpr std::size_t kLatest = 8;
  const std::size_t count = map.trail.size();
  for (const TrailPlace place : map.trail.last(count < kLatest ? count : kLatest)) {
    extent.include(place.millimetres(), 0);
  }
  for (const auto& object : map.objects) {
    if (const auto shape = shape_of(object)) shape->include_in(extent);
  }
  return TopView::of(extent, millimetres(robot.position), robot.heading);
}

template <class Profile>
std::size_t write_map_row(const MapContents<Profile>& map, const TopView& view, std::size_t row, std::span<char> out) {
  TopViewRow drawing(view, row);
  for (const TrailPlace place : map.trail) drawing.point(place.millimetres(), kTrailMark);
  for (std::size_t o = 0; o < map.objects.size(); ++o) {
    if (const auto shape = shape_of(map.objects[o])) shape->draw(letter_of(o), drawing);
  }
  drawing.robot();
  return drawing.write(out);
}

/// "^ robot  A red  B blue": as many as fit a line.
template <class Profile>
std::size_t write_legend(const MapContents<Profile>& map, const TopView& view, std::span<char> out) {
  constexpr std::size_t kRoomForOneMore = 79 - sensor::kMaxText - 4;
  const char arrow = robot_arrow(view);
  Sentence s(out);
  s.put({&arrow, 1}).put(" robot");
  if (!map.trail.empty()) s.put("  ").put({&kTrailMark, 1}).put(" where it was");
  for (std::size_t o = 0; o < map.objects.size(); ++o) {
    const recon::ObjectCore& object = map.objects[o];
    if (!drawn(object)) continue;
    if (s.column() > kRoomForOneMore) return s.put("  ...").end();
    const char letter = letter_of(o);
    s.put("  ").put({&letter, 1}).put(" ");
    const std::string_view name = name_of(object.signature, map.signatures);
    name.empty() ? s.put("sig ").number(object.signature) : s.put(name);
  }
  return s.end();
}

/// `line` < kMapLines; `view` as it was when the drawing began.
template <class Profile>
std::size_t write_map(const MapContents<Profile>& map, const TopView& view, std::size_t line, std::span<char> out) {
  if (line == 0) return write_map_title(view, out);
  if (line <= TopView::kRows) return write_map_row(map, view, line - 1, out);
  if (line == TopView::kRows + 1) return write_ticks(view, out);
  if (line == TopView::kRows + 2) return write_tick_numbers(view, out);
  return write_legend(map, view, out);
}

}  // namespace fencepost::console
