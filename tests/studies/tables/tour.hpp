// One random scene at one noise level, driven once: the log that a robot gets, and what only a test knows.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "hal/sensor/odometry.hpp"
#include "tests/studies/tables/noisy_views.hpp"

namespace fencepost::test {

struct GivenView {
  sensor::OdometrySample pose;  ///< as the log has it at the exposure
  std::vector<GivenBlob> blobs;
};

struct Tour {
  host::Scene scene;
  std::string log;
  std::vector<host::FrameTruth> frames;  ///< as in the log
  std::vector<GivenView> views;          ///< one for each frame
};

/// `scene` without noise, seen with that of `level`. Poses and boxes of `views` are those of `log`. Throws
/// std::runtime_error if the scene cannot be simulated.
Tour drive_tour(host::Scene scene, const NoiseLevel& level);

/// The robot's odometry, from the true samples, which come in order of time.
using OdometryNoise = std::function<sensor::OdometrySample(const sensor::OdometrySample&)>;

/// The same with the poses of `odometry`.
Tour drive_tour(host::Scene scene, const BlobNoise& noise, const OdometryNoise& odometry);

}  // namespace fencepost::test
