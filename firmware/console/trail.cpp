#include "firmware/console/trail.hpp"

#include <algorithm>

namespace fencepost::console {

TrailPlace TrailPlace::of(MapMillimetres place) {
  constexpr std::int32_t kLimit = INT16_MAX;
  return {static_cast<std::int16_t>(std::clamp(place.x / kUnit, -kLimit, kLimit)),
          static_cast<std::int16_t>(std::clamp(place.y / kUnit, -kLimit, kLimit))};
}

bool apart(TrailPlace a, TrailPlace b, std::int32_t spacing) {
  const std::int32_t dx = a.x - b.x;
  const std::int32_t dy = a.y - b.y;
  return std::max(dx < 0 ? -dx : dx, dy < 0 ? -dy : dy) >= spacing;
}

}  // namespace fencepost::console
