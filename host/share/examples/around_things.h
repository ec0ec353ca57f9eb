// Steers around what is in the way, by Core::ways(): the way that is free the farthest, rather straight on than not.
// Call it ten times a second and give the answer to the motors.
#include <fencepost/fencepost.hpp>

struct Wheels {
  float speed = 0;  // m/s
  float turn = 0;   // rad/s, to the left
};

template <class Core>
Wheels around_things(const Core& core) {
  if (core.level() == fencepost::Level::kBlind) return {};
  const float kFastest = 0.2F, kTurning = 0.8F;
  float most = 0.3F;         // m, a shorter way is not worth going
  Wheels best{0, kTurning};  // where no way is long enough: turn on the spot, and look
  fencepost::Way ways[fencepost::kWays];
  const std::size_t count = core.ways(ways, fencepost::kWays);
  for (std::size_t i = 0; i < count; ++i) {
    const float curvature = ways[i].curvature < 0 ? -ways[i].curvature : ways[i].curvature;
    const float worth = ways[i].free - 0.1F * curvature;
    if (ways[i].motion != FENCEPOST_FORWARD || worth <= most) continue;
    most = worth;
    best.speed = ways[i].speed < kFastest ? ways[i].speed : kFastest;
    best.turn = best.speed * ways[i].curvature;
  }
  return best;
}
