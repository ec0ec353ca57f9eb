// The map in characters, in a part of the screen: x up, y to the left, as the robot's own `map`.
#pragma once

#include "host/monitor/believed.hpp"
#include "host/monitor/cells.hpp"

namespace fencepost::host::monitor {

/// Rows and columns of a screen, `bottom` and `right` not included.
struct Part {
  std::size_t top = 0;
  std::size_t left = 0;
  std::size_t bottom = 0;
  std::size_t right = 0;
};

/// The robot, where it was, objects by their letters, alerts of "something" as '!', and a bar of known length.
void draw_map(Cells& cells, Part part, const Believed& believed);

/// A to Z, then again.
inline char letter_of(std::uint32_t id) { return static_cast<char>('A' + (id + 25) % 26); }
Style style_of(const record::ObjectReport& object, const Believed& believed);

}  // namespace fencepost::host::monitor
