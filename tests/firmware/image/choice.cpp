// Compiled once for each choice of a camera and an odometry: each is what the loop expects.
#include "hal/sensor/sources.hpp"

#include FENCEPOST_CAMERA
#include FENCEPOST_ODOMETRY

namespace fencepost::image {

static_assert(sensor::BlobCamera<Camera>);
static_assert(sensor::OdometrySource<Odometry>);

sensor::CameraIntrinsics begin(console::Counters& counters, base::Time now);
sensor::CameraIntrinsics begin(console::Counters& counters, base::Time now) {
  Camera::start();
  Odometry::start();
  Camera camera(counters);
  Odometry odometry(counters);
  static_cast<void>(camera.poll(now));
  static_cast<void>(odometry.poll(now));
  return Camera::calibration();
}

}  // namespace fencepost::image
