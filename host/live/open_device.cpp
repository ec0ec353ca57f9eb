#include "host/live/open_device.hpp"

#include "host/live/open_camera.hpp"
#include "host/live/open_odometry.hpp"

namespace fencepost::host {
namespace {

std::optional<sensor::CameraIntrinsics> intrinsics_of(const DeviceSpec& camera, const RobotFile& robot) {
  if (const auto profile = profile_of(camera)) return robot.camera.over(*profile);
  if (!robot.camera.complete()) return std::nullopt;
  sensor::CameraIntrinsics nothing;
  nothing.model = "camera";
  return robot.camera.over(nothing);
}

void refuse_one_port_twice(const DeviceSpec& camera, const DeviceSpec& odometry) {
  if (camera.place.kind == PlaceKind::kNone || camera.place.kind == PlaceKind::kUsb) return;
  if (camera.place.kind != odometry.place.kind || camera.place.name != odometry.place.name) return;
  if (camera.place.port != odometry.place.port) return;
  throw DeviceFailure{true, camera.where() + " and " + odometry.where() + " cannot both have that port"};
}

}  // namespace

std::variant<Devices, DeviceFailure> open_devices(const DeviceSpec& camera, const DeviceSpec& odometry,
                                                  const RobotFile& robot, linux::MonotonicClock clock, bool wait) {
  try {
    refuse_one_port_twice(camera, odometry);
    Devices devices;
    const std::shared_ptr<BrickStation> brick = open_brick(odometry, wait);
    devices.odometry = open_odometry(odometry, robot, brick, clock, wait);
    devices.camera = open_camera(camera, robot, brick, wait);
    devices.camera->introduce(DeviceRole::kCamera, camera);
    devices.odometry->introduce(DeviceRole::kOdometry, odometry);
    devices.intrinsics = intrinsics_of(camera, robot);
    return devices;
  } catch (DeviceFailure& failure) {
    return std::move(failure);
  }
}

}  // namespace fencepost::host
