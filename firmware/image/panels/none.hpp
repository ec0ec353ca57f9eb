// FENCEPOST_PANEL=none: the board has nothing to show things on.
#pragma once

#include "firmware/console/links.hpp"
#include "firmware/loop/pipeline.hpp"

namespace fencepost::image {

template <class Profile>
struct Panel {
  explicit Panel(loop::Pipeline<Profile>& /*pipeline*/) {}
  static void start() {}
  static void turn(const console::Links& /*links*/) {}
};

}  // namespace fencepost::image
