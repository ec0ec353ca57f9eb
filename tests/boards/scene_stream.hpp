// A scene as a board's sensors would bring it: calibration first, then odometry and frames at their times.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "hal/sensor/blob_frame.hpp"
#include "hal/sensor/odometry.hpp"
#include "host/scene/scene.hpp"

namespace fencepost::test {

struct SceneStream {
  using Input = std::variant<sensor::OdometrySample, sensor::BlobFrame>;

  std::string log;                       ///< as the simulator wrote it
  std::vector<std::string> calibration;  ///< FPCAM and FPSIG lines, with line ends
  std::vector<Input> inputs;             ///< in order of time

  /// Its odometry.
  [[nodiscard]] std::vector<sensor::OdometrySample> way() const;
};

SceneStream stream_of(const host::Scene& scene);
/// A scene of host/share/recordings.
host::Scene recorded_scene(const std::string& name);
/// One minute: twice around three boxes and out again. `rate`: frames a second.
host::Scene minute_scene(double seconds = 60, double rate = 20);

/// Straight on, past a red box, for a robot whose wheels begin at the map's origin. `camera` is the one it has.
host::Scene box_beside_the_way(const sensor::CameraIntrinsics& camera);

/// Eight boxes in a ring, all in view, 50 frames/s: as much as profile small can hold.
host::Scene eight_boxes(double seconds);
/// Four boxes, likewise, 20 frames/s, for profile micro.
host::Scene four_boxes(double seconds);

}  // namespace fencepost::test
