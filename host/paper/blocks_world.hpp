// The scenes of the paper's evaluation: blocks on a floor, seen from a circle of 75 views.
#pragma once

#include <cstddef>
#include <cstdint>

#include "host/scene/scene.hpp"

namespace fencepost::host {

enum class BlocksWorld : unsigned char {
  kFigures,     ///< the two landmarks, always in view: Figures 4 to 8 and 12 to 14
  kPaperLike,   ///< a third block, distinct colours, the camera sways: landmarks leave the image (Figure 10)
  kDistractor,  ///< and a fourth block in one landmark's colour
  kHard,        ///< and background in the landmarks' hues, and more noise
};

inline constexpr int kPaperViews = 75;
inline constexpr std::size_t kRedLandmark = 0;     ///< index among the scene's objects
inline constexpr std::size_t kYellowLandmark = 1;  ///< index among the scene's objects

/// The same seed gives the same scene. A red box and a yellow round or square block (in kFigures by the seed's parity)
/// of 8 to 22 cm. All are higher than the lens, so occlusion is that of the plane. Grey panels 2 to 3.5 m away are the
/// background. Camera: 176x144 px, 43 degrees, level, 15 cm above the floor. Noise: medium (edges 1.5 px, 5 % of the
/// segments lose a piece, 2 % grow, 2 % are missed; poses 4 mm, 0.4 degrees), for kHard high. `noisy` false: only whole
/// pixels.
Scene blocks_world(BlocksWorld kind, std::uint64_t seed, bool noisy = true);

/// Blocks stand before panels in Scene::objects.
std::size_t block_count(BlocksWorld kind);

/// Each channel of each region's colour is off by this, sigma (0 to 255).
inline constexpr double kColourNoise = 12;

}  // namespace fencepost::host
