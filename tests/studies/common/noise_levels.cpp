#include "tests/studies/common/noise_levels.hpp"

#include <algorithm>
#include <numbers>

namespace fencepost::test {

const std::array<NoiseLevel, 7>& noise_levels() {
  // Edge jitter; lost, grown, missed, false; pose.
  static constexpr std::array<NoiseLevel, 7> kLevels{{
      {"0", "noise 0 ideal", {0, 0, 0, 0, 0}, 0, 0},
      {"1", "noise 1 low", {1, 0, 0, 0, 0}, 0.002, 0.2},
      {"2", "noise 2 medium", {1.5, 0.05, 0.02, 0.02, 0}, 0.005, 0.5},
      {"3", "noise 3 high", {2, 0.10, 0.05, 0.05, 0.02}, 0.010, 1},
      {"4", "noise 4 severe", {3, 0.20, 0.05, 0.10, 0.05}, 0.015, 1.5},
      {"S", "noise S segloss10", {1, 0.10, 0, 0, 0}, 0, 0},
      {"T", "noise T segloss20+grow5", {1, 0.20, 0.05, 0, 0}, 0, 0},
  }};
  return kLevels;
}

std::vector<NoiseLevel> noise_levels(const std::vector<std::string>& keys) {
  std::vector<NoiseLevel> chosen;
  for (const NoiseLevel& level : noise_levels()) {
    if (keys.empty() || std::find(keys.begin(), keys.end(), level.key) != keys.end()) chosen.push_back(level);
  }
  return chosen;
}

host::SceneNoise scene_noise(const NoiseLevel& level) {
  constexpr double kObjects = 3;
  host::SceneNoise noise;
  noise.edge_px = level.blob.edge_px;
  noise.loss_probability = level.blob.loss;
  noise.growth_probability = level.blob.growth;
  noise.growth_max = 0.6;
  noise.miss_probability = level.blob.miss;
  noise.false_rate = kObjects * level.blob.false_blob;
  noise.pose_xy = level.pose_xy;
  noise.pose_heading = level.pose_heading * std::numbers::pi / 180;
  return noise;
}

}  // namespace fencepost::test
