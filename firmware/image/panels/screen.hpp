// FENCEPOST_PANEL=screen: the board's screen shows the map, its buttons change what is shown.
#pragma once

#include "firmware/loop/pipeline.hpp"
#include "firmware/view/map_view.hpp"
#include FENCEPOST_BOARD

namespace fencepost::image {

template <class Profile>
class Panel {
 public:
  explicit Panel(loop::Pipeline<Profile>& pipeline) : view_(pipeline, board::screen()) {}
  void start() { view_.start(); }
  void turn(const console::Links& links) {
    view_.press(board::buttons());
    view_.turn(links);
  }

 private:
  view::MapView<loop::Pipeline<Profile>, board::Screen> view_;
};

}  // namespace fencepost::image
