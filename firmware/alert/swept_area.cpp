#include "firmware/alert/swept_area.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/alert/tuning.hpp"
#include "firmware/recon/floor_frame.hpp"
#include "firmware/recon/guard/tuning.hpp"

namespace fencepost::alert {

SweptArea::SweptArea(const RobotPath& path, float less) : ways_(path.motion) {
  using recon::nearest_whole;
  constexpr float kMillimetres = 1000;
  half_width_ = std::max(nearest_whole(kMillimetres * (path.half_width - less)), recon::guard::kSpacing / 2);
  if (!ways_.arc) return;
  const std::int32_t radius = nearest_whole(kMillimetres * path.motion.forward / path.motion.turn);
  twice_radius_ = 2 * radius;
  const std::int32_t twice = std::abs(twice_radius_);
  outer_ = half_width_ * (half_width_ + twice);
  inner_ = 2 * half_width_ < twice ? half_width_ * (half_width_ - twice) : -(radius * radius);
}

bool SweptArea::contains(std::int32_t x, std::int32_t y) const {
  if (x == 0 || !(x > 0 ? ways_.ahead : ways_.behind)) return false;
  if (ways_.straight && y <= half_width_ && y >= -half_width_) return true;
  if (!ways_.arc) return false;
  const std::int32_t beyond = x * x + y * (y - twice_radius_);
  return beyond <= outer_ && beyond >= inner_;
}

}  // namespace fencepost::alert
