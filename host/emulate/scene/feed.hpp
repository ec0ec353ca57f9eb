// The input of the emulated devices: a scene, or a recorded log, on one clock.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/record/records.hpp"
#include "hal/sensor/blob_frame.hpp"
#include "hal/sensor/camera.hpp"
#include "hal/sensor/odometry.hpp"
#include "host/scene/scene.hpp"

namespace fencepost::emulate {

/// Frames come at their t, that is when the camera's bytes came, `latency` after the exposure; poses are true at
/// theirs.
struct Feed {
  std::optional<sensor::CameraIntrinsics> camera;  ///< that the boxes are of
  std::vector<record::Signature> signatures;
  std::vector<sensor::BlobFrame> frames;
  std::vector<sensor::OdometrySample> poses;
  std::vector<std::string> notes;  ///< parts that were not used, a sentence each
  std::string problem;             ///< why nothing can be played; empty if something can

  /// Times of the first frame or pose, and of the last.
  [[nodiscard]] base::Time begin() const;
  [[nodiscard]] base::Time end() const;
  [[nodiscard]] std::optional<sensor::Rgb> colour_of(std::uint8_t signature) const;
};

/// The scene's robot as `fencepost simulate` has it.
Feed feed_from_scene(const host::Scene& scene);

/// The first run of a log: its inputs, not its results. `name` is for messages.
Feed feed_from_log(std::string_view bytes, const std::string& name);

}  // namespace fencepost::emulate
