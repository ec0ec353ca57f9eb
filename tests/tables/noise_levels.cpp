#include "tests/tables/noise_levels.hpp"

#include <numbers>

namespace fencepost::test {
namespace {

/// Edge jitter (px), shares of lost, grown and missed blobs, false blobs an object, pose noise (m, degrees).
host::SceneNoise noise(double edge, double loss, double growth, double miss, double false_blobs, double xy,
                       double heading) {
  host::SceneNoise levels;
  levels.edge_px = edge;
  levels.loss_probability = loss;
  levels.growth_probability = growth;
  levels.growth_max = 0.6;  // the published tables grow by 10 to 60 %, the simulator by 0 to this
  levels.miss_probability = miss;
  levels.false_rate =
      3 * false_blobs;  // there a false blob takes an object's place, here it comes beside three of them
  levels.pose_xy = xy;
  levels.pose_heading = heading * std::numbers::pi / 180;
  return levels;
}

}  // namespace

const std::array<NoiseLevel, 7>& noise_levels() {
  static const std::array<NoiseLevel, 7> levels{{
      {"0", "noise 0 ideal", noise(0, 0, 0, 0, 0, 0, 0)},
      {"1", "noise 1 low", noise(1, 0, 0, 0, 0, 0.002, 0.2)},
      {"2", "noise 2 medium", noise(1.5, 0.05, 0.02, 0.02, 0, 0.005, 0.5)},
      {"3", "noise 3 high", noise(2, 0.10, 0.05, 0.05, 0.02, 0.010, 1)},
      {"4", "noise 4 severe", noise(3, 0.20, 0.05, 0.10, 0.05, 0.015, 1.5)},
      {"S", "noise S segloss10", noise(1, 0.10, 0, 0, 0, 0, 0)},
      {"T", "noise T segloss20+grow5", noise(1, 0.20, 0.05, 0, 0, 0, 0)},
  }};
  return levels;
}

}  // namespace fencepost::test
