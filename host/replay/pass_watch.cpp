#include "host/replay/pass_watch.hpp"

#include <algorithm>
#include <cmath>

namespace fencepost::host {

void PassWatch::look(double t, std::uint32_t id, std::uint8_t signature, Point relative, double radius) {
  const auto known = ahead_.find(id);
  if (relative.x > kAhead) {
    if (known != ahead_.end()) return;
    const double distance = std::hypot(relative.x, relative.y);
    if (distance > kFarthest) return;
    PassResult pass;
    pass.id = id;
    pass.signature = signature;
    pass.known_at = t;
    pass.bearing = std::atan2(relative.y, relative.x);
    pass.known_distance = std::max(0.0, distance - radius);
    ahead_.emplace(id, pass);
  } else if (relative.x < -kAhead && known != ahead_.end()) {
    PassResult pass = known->second;
    ahead_.erase(known);
    pass.t = t;
    pass.on_the_right = relative.y > 0;
    pass.distance = std::max(0.0, std::abs(relative.y) - radius);
    if (pass.distance <= kWidest && !full()) passes_.push_back(pass);
  }
}

}  // namespace fencepost::host
