// Simulates the robot of a scene driving its path; its sensors' output is a record stream.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "hal/base/result.hpp"
#include "host/scene/scene.hpp"

namespace fencepost::host {

/// Incremented whenever the same scene gives different bytes. Written as the version of FPHDR.
inline constexpr std::string_view kSimulatorVersion = "0.1.0";

struct SimulationSummary {
  std::uint64_t frames = 0;          ///< written
  std::uint64_t frames_dropped = 0;  ///< by noise.frame_drop_probability
  std::uint64_t odometry = 0;
  std::uint64_t blobs = 0;
  std::uint64_t blobs_dropped = 0;  ///< beyond the camera's max_blobs
  std::uint64_t frames_inside = 0;  ///< exposed from inside an object: the path crosses it
  double duration = 0;              ///< s, stream time of the last record
};

/// Receives one record, line end included.
using LineSink = std::function<void(std::string_view line)>;

/// Writes FPHDR, FPCAM, FPSIG, then FPODO (50 Hz) and FPFRM in order of arrival. Same scene, same bytes.
/// The error is a sentence for the user. The scene has no path, its image more than 64 megapixels, or the run would
/// leave the stream's ranges.
base::Result<SimulationSummary, std::string> simulate(const Scene& scene, const LineSink& sink);

}  // namespace fencepost::host
