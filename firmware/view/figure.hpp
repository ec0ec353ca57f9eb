// Objects and the robot as shapes on the screen.
#pragma once

#include <cstdint>
#include <span>

#include "firmware/recon/object.hpp"
#include "firmware/recon/pose_history.hpp"
#include "firmware/view/shapes.hpp"
#include "firmware/view/window.hpp"

namespace fencepost::view {

/// An object on the map: its cylinder as a disc, its outline where the views have cut one.
struct Figure {
  Disc disc;
  Polygon outline;
  Label letter;
};

/// `object`: one that app::drawn() holds for; `outline`: of its clip, local frame, metres.
Figure make_figure(const recon::ObjectCore& object, std::span<const recon::Vec2> outline, std::size_t slot,
                   const Window& window);

/// An arrow head of fixed size: a robot in scale would often be a dot.
Polygon make_robot(const recon::MapPose& pose, const Window& window);

}  // namespace fencepost::view
