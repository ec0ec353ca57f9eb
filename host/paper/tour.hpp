// One scene, simulated once: the robot's inputs, and the ground truth.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "hal/sensor/odometry.hpp"
#include "host/metrics/reacquisition.hpp"
#include "host/render/picture.hpp"
#include "host/scene/scene.hpp"
#include "host/simulate/truth.hpp"

namespace fencepost::host {

/// The regions of one image, with the truth about each.
struct RealImage {
  std::vector<Region> regions;
  std::vector<BlobTruth> truths;
};

/// The ends of an object's widest region that the border or a nearer object cuts. Noise that takes a piece away, or
/// adds one, does not change them.
struct HiddenEnds {
  bool left = false;
  bool right = false;
};

struct Tour {
  Scene scene;
  std::string log;
  std::vector<FrameTruth> frames;
  std::vector<sensor::OdometrySample> poses;    ///< as the log has them, at each frame's exposure
  std::vector<RealImage> images;                ///< one for each frame
  std::vector<std::vector<HiddenEnds>> hidden;  ///< by frame and object
  /// The camera's photograph by the frame's number; none: images are drawn from the scene.
  std::function<Picture(std::uint32_t)> photograph;
};

/// errors: std::runtime_error: the scene cannot be simulated, or has no odometry at an exposure.
Tour drive(const Scene& scene);

/// The believed pose of the robot at frame `frame`.
TimedPose believed_pose(const Tour& tour, std::size_t frame);

/// An expected find: a region of that object alone, with both of its ends, at least kMinWhole wide.
bool is_whole_in(const RealImage& image, std::size_t object);
inline constexpr double kMinWhole = 12;  ///< px

/// True if the region is of that object, or of several with it among them.
bool is_of(const BlobTruth& region, std::size_t object);

}  // namespace fencepost::host
