// Ground truth of the simulator's frames. For tests and measurements; no product code reads it.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "hal/sensor/blob_frame.hpp"
#include "host/scene/scene.hpp"
#include "host/simulate/simulate.hpp"

namespace fencepost::host {

/// The true nature of one side of a blob's box.
enum class BlobEnd : unsigned char {
  kEdge,      ///< the object's own edge, up to jitter
  kBorder,    ///< within the image border (x1 <= 1, x2 >= width - 2): censored
  kOccluded,  ///< the object goes on behind a nearer one
  kLost,      ///< noise took a piece away on this side
  kGrown,     ///< noise added a piece on this side
};

struct BlobTruth {
  std::optional<std::size_t> object;  ///< index into Scene::objects; empty: a false blob
  std::vector<std::size_t> others;    ///< objects of its signature that touch it in the image: one blob of several
  BlobEnd left = BlobEnd::kEdge;
  BlobEnd right = BlobEnd::kEdge;
  double distance = 0;  ///< m, from the camera to the nearest visible point, in the plane, along the optical axis
};

struct FrameTruth {
  sensor::BlobFrame frame;  ///< as written
  base::Time exposure;
  TimedPose pose;                ///< true pose of the robot at the exposure
  std::vector<BlobTruth> blobs;  ///< one for each blob of `frame`, same order
};

/// As `simulate`, with the ground truth of every written frame.
base::Result<SimulationSummary, std::string> simulate_with_truth(const Scene& scene, const LineSink& sink,
                                                                 const std::function<void(const FrameTruth&)>& truth);

/// The caller drives, for example by the records that the sink has got so far.
struct Driven {
  /// Where the robot is at t, s. Asked for times up to that of the next record, never ahead of it.
  std::function<TimedPose(double t)> pose;
  /// The run is over; asked at each sample of odometry.
  std::function<bool(double t)> ended;
  double duration = 0;  ///< s, it lasts no longer
};

/// As `simulate_with_truth`; the scene's path is not used.
base::Result<SimulationSummary, std::string> simulate_driven(const Scene& scene, const Driven& driven,
                                                             const LineSink& sink,
                                                             const std::function<void(const FrameTruth&)>& truth);

}  // namespace fencepost::host
