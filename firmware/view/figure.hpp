// Objects and the robot as shapes on the screen.
#pragma once

#include <cstddef>

#include "firmware/console/map_shape.hpp"
#include "firmware/recon/observe/pose_history.hpp"
#include "firmware/view/shapes.hpp"
#include "firmware/view/window.hpp"

namespace fencepost::view {

/// An object on the map, in the colour of its slot.
struct Figure {
  Disc disc;        ///< painted if there is no outline
  Polygon outline;  ///< with a lighter edge
  Label letter;

  void paint(Row& row) const;
};

/// A shape that is too small to be seen becomes a small disc.
Figure make_figure(const console::MapShape& shape, std::size_t slot, const Window& window);

/// An arrow head of fixed size: a robot in scale would often be a dot.
Polygon make_robot(const recon::MapPose& pose, const Window& window);

}  // namespace fencepost::view
