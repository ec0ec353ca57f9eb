// A camera's numbers, as the files of scenes and of robots have them.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "host/scene/json_reader.hpp"
#include "host/scene/scene.hpp"

namespace fencepost::host {

/// The file's numbers of the camera; the rest stays as in the camera's own profile. Units as in CameraIntrinsics.
struct CameraNumbers {
  std::optional<sensor::Text> model;
  std::optional<std::uint16_t> width;
  std::optional<std::uint16_t> height;
  std::optional<base::Pixels2> fx;
  std::optional<base::Pixels2> fy;
  std::optional<base::Pixels2> cx;
  std::optional<base::Pixels2> cy;
  std::optional<base::Ratio4> k1;
  std::optional<sensor::Lens> lens;
  std::optional<sensor::CameraMount> mount;
  std::optional<base::Duration> latency;

  /// Enough for a camera without a profile.
  [[nodiscard]] bool complete() const { return width && height && fx && fy && cx && cy; }
  [[nodiscard]] sensor::CameraIntrinsics over(sensor::CameraIntrinsics profile) const;
};

/// errors: SceneProblem
CameraNumbers read_camera_numbers(const JsonNode& node);

/// As both files have them.
nlohmann::ordered_json camera_json(const sensor::CameraIntrinsics& camera);
nlohmann::ordered_json signature_json(const SceneSignature& signature);

}  // namespace fencepost::host
