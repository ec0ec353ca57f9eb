// `map`: the state of the map as a drawing, line by line.
#pragma once

#include <cstddef>
#include <span>

#include "firmware/app/pipeline.hpp"
#include "firmware/app/sentence.hpp"
#include "firmware/app/top_view.hpp"

namespace fencepost::app {

/// Title, rows, lower edge, its numbers, legend.
inline constexpr std::size_t kMapLines = TopView::kRows + 4;

inline MapMillimetres millimetres(recon::MapPoint place) {
  constexpr std::int32_t kPerMillimetre = recon::kMapUnitsPerMetre / 1000;
  return {place.x / kPerMillimetre, place.y / kPerMillimetre};
}

/// Where the object is drawn; only if its cylinder is known.
inline MapMillimetres center_of(const recon::ObjectCore& object) {
  return millimetres(recon::moved(object.origin, object.cylinder.estimate().center));
}
inline std::int32_t radius_of(const recon::ObjectCore& object) {
  constexpr float kLargest = 100.0F;  // m
  return static_cast<std::int32_t>(1000 * std::min(object.cylinder.estimate().radius, kLargest));
}
inline bool drawn(const recon::ObjectCore& object) { return object.used() && object.cylinder.estimate().ok(); }

/// Is it drawn as its outline? As a disc it is where that is not known well.
template <class Profile>
bool outlined(const recon::Object<Profile>& object) {
  return object.hybrid.ok() && object.hybrid.outline().known_well();
}

inline std::int32_t whole_millimetres(float metres) {
  constexpr float kFarthest = 100.0F;  // m
  return static_cast<std::int32_t>(1000 * std::clamp(metres, -kFarthest, kFarthest));
}

/// The four ends of an outline along the axes.
inline void include(const recon::OutlineView& outline, MapMillimetres origin, MapExtent& extent) {
  const std::size_t quarter = outline.offsets.size() / 4;
  const auto reach = [&](std::size_t k) { return whole_millimetres(outline.offset(k * quarter)); };
  extent.include({origin.x + reach(0), origin.y + reach(1)}, 0);
  extent.include({origin.x - reach(2), origin.y - reach(3)}, 0);
}

/// The part of an outline that lies in this row.
inline void draw(const recon::OutlineView& outline, MapMillimetres origin, char letter, TopViewRow& row) {
  row.point(origin, letter);
  const recon::Chord chord = outline.chord_at(0.001F * static_cast<float>(row.x() - origin.x));
  if (chord.empty()) return;
  row.bar(origin.y + whole_millimetres(chord.low), origin.y + whole_millimetres(chord.high), letter);
}

/// Needs a pose of the robot.
template <class Profile>
TopView view_of(const Memory<Profile>& memory) {
  const recon::MapPose pose = robot_pose(memory);
  MapExtent extent;
  extent.include(millimetres(pose.position), 0);
  for (const auto& object : memory.map.slots()) {
    if (!drawn(object)) continue;
    if (outlined(object)) {
      include(object.hybrid.outline(), millimetres(object.hybrid.origin), extent);
    } else {
      extent.include(center_of(object), radius_of(object));
    }
  }
  return TopView::of(extent, millimetres(pose.position), pose.heading);
}

template <class Profile>
std::size_t write_map_row(const Memory<Profile>& memory, std::size_t row, std::span<char> out) {
  TopViewRow drawing(memory.console.view, row);
  for (std::size_t o = 0; o < Profile::kObjects; ++o) {
    const auto& object = memory.map.slots()[o];
    if (!drawn(object)) continue;
    if (outlined(object)) {
      draw(object.hybrid.outline(), millimetres(object.hybrid.origin), letter_of(o), drawing);
    } else {
      drawing.disc(center_of(object), radius_of(object), letter_of(o));
    }
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
