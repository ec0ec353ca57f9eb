// `map`: the state of the map as a drawing, line by line.
#pragma once

#include <cstddef>
#include <span>

#include "firmware/console/map_shape.hpp"
#include "firmware/console/sentence.hpp"
#include "firmware/console/top_view.hpp"
#include "firmware/loop/pipeline.hpp"

namespace fencepost::app {

/// Title, rows, lower edge, its numbers, legend.
inline constexpr std::size_t kMapLines = TopView::kRows + 4;

/// Needs a pose of the robot.
template <class Profile>
TopView view_of(const Memory<Profile>& memory) {
  const recon::MapPose pose = robot_pose(memory);
  MapExtent extent;
  extent.include(millimetres(pose.position), 0);
  for (const auto& object : memory.map.slots()) {
    if (const auto shape = shape_of(object)) shape->include_in(extent);
  }
  return TopView::of(extent, millimetres(pose.position), pose.heading);
}

template <class Profile>
std::size_t write_map_row(const Memory<Profile>& memory, std::size_t row, std::span<char> out) {
  TopViewRow drawing(memory.console.view, row);
  for (std::size_t o = 0; o < Profile::kObjects; ++o) {
    if (const auto shape = shape_of(memory.map.slots()[o])) shape->draw(letter_of(o), drawing);
  }
  drawing.robot();
  return drawing.write(out);
}

/// "^ robot  A red  B blue": as many as fit a line.
template <class Profile>
std::size_t write_legend(const Pipeline<Profile>& pipeline, std::span<char> out) {
  constexpr std::size_t kRoomForOneMore = 79 - sensor::kMaxText - 4;
  const char arrow = robot_arrow(pipeline.memory().console.view);
  Sentence s(out);
  s.put({&arrow, 1}).put(" robot");
  for (std::size_t o = 0; o < Profile::kObjects; ++o) {
    const recon::ObjectCore& object = pipeline.memory().map.slots()[o];
    if (!drawn(object)) continue;
    if (s.column() > kRoomForOneMore) return s.put("  ...").end();
    const char letter = letter_of(o);
    s.put("  ").put({&letter, 1}).put(" ");
    const std::string_view name = pipeline.telling().name_of(object.signature);
    name.empty() ? s.put("sig ").number(object.signature) : s.put(name);
  }
  return s.end();
}

/// `line` < kMapLines, after memory.console.view was set.
template <class Profile>
std::size_t write_map(const Pipeline<Profile>& pipeline, std::size_t line, std::span<char> out) {
  const Memory<Profile>& memory = pipeline.memory();
  if (line == 0) return write_map_title(memory.console.view, out);
  if (line <= TopView::kRows) return write_map_row(memory, line - 1, out);
  if (line == TopView::kRows + 1) return write_ticks(memory.console.view, out);
  if (line == TopView::kRows + 2) return write_tick_numbers(memory.console.view, out);
  return write_legend(pipeline, out);
}

}  // namespace fencepost::app
