// FENCEPOST_PANEL=none: the board has nothing to show things on.
#pragma once

#include "firmware/loop/listings.hpp"
#include "firmware/loop/pipeline.hpp"

namespace fencepost::image {

template <class Profile>
struct Panel {
  explicit Panel(app::Pipeline<Profile>& /*pipeline*/) {}
  static void start() {}
  static void turn(const app::Links& /*links*/) {}
};

}  // namespace fencepost::image
