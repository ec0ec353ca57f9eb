// The seven noise levels of the reference figures. At none of them are boxes padded.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "host/scene/scene.hpp"

namespace fencepost::test {

/// The noise of one object's blob in one view. Lost: 10..50 % of the width, 30 % of the losses split the blob and the
/// larger part stays. Grown: by 10..60 % of the width.
struct BlobNoise {
  double edge_px = 0;  ///< sigma of each edge
  double loss = 0;     ///< probabilities
  double growth = 0;
  double miss = 0;
  double false_blob = 0;  ///< something else of its colour is taken for the object: 3..40 px wide, anywhere
};

struct NoiseLevel {
  std::string_view key;  ///< on the command line
  std::string_view name;
  BlobNoise blob;
  double pose_xy = 0;       ///< m, sigma of each coordinate in each view
  double pose_heading = 0;  ///< degrees
};

const std::array<NoiseLevel, 7>& noise_levels();

/// Those with these keys, in the order of noise_levels(); no keys: all.
std::vector<NoiseLevel> noise_levels(const std::vector<std::string>& keys);

/// The level as the simulator has it, for scenes of about three objects. False blobs come beside objects and not in
/// their place, growth is 0..60 %, and both parts of a split blob stay.
host::SceneNoise scene_noise(const NoiseLevel& level);

/// The camera nods: sigma of the pitch in each view, degrees, at every level. Moves the bottom row only.
inline constexpr double kPitchNoise = 0.3;

}  // namespace fencepost::test
