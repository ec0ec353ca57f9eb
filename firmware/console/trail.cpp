#include "firmware/console/trail.hpp"

#include <algorithm>

namespace fencepost::console {
namespace {

constexpr std::int32_t kLimit = INT16_MAX;

}  // namespace

void Trail::push(MapMillimetres robot) {
  const auto unit = [](std::int32_t mm) { return std::clamp(mm / kUnit, -kLimit, kLimit); };
  const std::int32_t x = unit(robot.x);
  const std::int32_t y = unit(robot.y);
  if (!places_.empty()) {
    const Place last = places_[places_.size() - 1];
    const std::int32_t dx = x - last.x;
    const std::int32_t dy = y - last.y;
    if (std::max(dx < 0 ? -dx : dx, dy < 0 ? -dy : dy) < spacing_) return;
  }
  if (places_.size() == kMost) {
    base::FixedVector<Place, kMost> kept;
    for (std::size_t i = 0; i < kMost; i += 2) static_cast<void>(kept.push_back(places_[i]));
    places_ = kept;
    if (spacing_ < kLimit / 2) spacing_ *= 2;
  }
  static_cast<void>(places_.push_back({static_cast<std::int16_t>(x), static_cast<std::int16_t>(y)}));
}

}  // namespace fencepost::console
