// Locates the start of a run in a known map, by the sightings from its start on. For runs that are too short to make a
// map of their own.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "hal/sensor/camera.hpp"
#include "host/relocation/relocation.hpp"
#include "host/result/result.hpp"

namespace fencepost::host {

struct RelocateOptions {
  std::optional<sensor::CameraIntrinsics> camera{};  ///< for logs without FPCAM
  std::optional<double> from{};                      ///< s, stream time: odometry counts from there
  std::optional<double> to{};
};

struct Relocated {
  double after = 0;           ///< s, from the first frame to the one that settled it
  recon::FrameMotion motion;  ///< from the frame of the run's odometry to the map's
  recon::Relocation found;
};

/// `run`: the bytes of one run. Nothing: it was not sure.
std::optional<Relocated> relocate(std::string_view run, std::span<const recon::ConstellationPoint> known,
                                  const RelocateOptions& options);

}  // namespace fencepost::host
