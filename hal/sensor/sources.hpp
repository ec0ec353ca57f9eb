// The second seam: meaning. Drivers and replayed logs offer these; the loop sees nothing else of a sensor.
#pragma once

#include <concepts>

#include "hal/base/result.hpp"
#include "hal/base/units.hpp"
#include "hal/sensor/blob_frame.hpp"
#include "hal/sensor/link_state.hpp"
#include "hal/sensor/odometry.hpp"

namespace fencepost::sensor {

/// `poll(now)` never waits. It answers the next whole frame, or kNotReady. Blobs are in the convention of Blob.
/// `dropped()` counts the blobs that the sensor saw and the frame could not hold, since start-up.
template <class T>
concept BlobCamera = requires(T camera, const T& same, base::Time now) {
  { camera.poll(now) } -> std::same_as<base::Result<BlobFrame>>;
  { same.link() } -> std::same_as<LinkState>;
  { same.dropped() } -> std::same_as<std::uint32_t>;
};

/// `poll(now)` never waits. It answers the next sample in order of time, or kNotReady.
template <class T>
concept OdometrySource = requires(T odometry, const T& same, base::Time now) {
  { odometry.poll(now) } -> std::same_as<base::Result<OdometrySample>>;
  { same.link() } -> std::same_as<LinkState>;
};

/// Is it this robot's clock that stamps what the source gives? One for which it is not (a log, or another controller
/// that sends records) says so by `stamped_here()`.
template <class Source>
[[nodiscard]] bool stamped_here(const Source& source) {
  if constexpr (requires { source.stamped_here(); }) return source.stamped_here();
  return true;
}

}  // namespace fencepost::sensor
