#include "firmware/view/picture.hpp"

namespace fencepost::view {

void paint_ground(const Window& window, Row& row) {
  row.fill(0, Window::kSide - 1, kGround);
  const std::int32_t pitch = window.grid_mm() / window.mm();
  const Point origin = window.pixel_of({0, 0});
  const auto first = [pitch](std::int32_t at) { return ((at % pitch) + pitch) % pitch; };
  if (first(origin.y - row.y()) == 0) {
    row.fill(0, Window::kSide - 1, kGrid);
    return;
  }
  for (std::int32_t x = first(origin.x); x < Window::kSide; x += pitch) row.fill(x, x, kGrid);
}

}  // namespace fencepost::view
