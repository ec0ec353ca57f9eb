#include "host/devices/open_devices.hpp"

namespace fencepost::devices {
namespace {

using host::DeviceFailure;
using host::Devices;

const CameraDriver& camera_driver(const DeviceSpec& spec) { return std::get<CameraDriver>((*spec.row->live)->driver); }
const OdometryDriver& odometry_driver(const DeviceSpec& spec) {
  return std::get<OdometryDriver>((*spec.row->live)->driver);
}

std::optional<sensor::CameraIntrinsics> intrinsics_of(const DeviceSpec& camera, const host::RobotFile& robot) {
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

host::PortRequest Opening::port() const { return {spec.kind_name(), wait}; }

std::optional<sensor::CameraIntrinsics> profile_of(const DeviceSpec& camera) {
  return (*camera_driver(camera).profile)(camera);
}

std::optional<sensor::CameraIntrinsics> nominal_camera(const Row& row) {
  if (!row.live->has_value() || *row.role != Role::kCamera) return std::nullopt;
  DeviceSpec spec;
  spec.row = &row;
  return profile_of(spec);
}

host::DeviceLabel label_of(const DeviceSpec& spec) {
  const std::string sensor = *spec.row->role == Role::kCamera ? "camera " : "odometry ";
  return {sensor + spec.where(), spec.kind_name(), spec.place.name, std::string(silent_remedy(spec.place.kind)),
          *(*spec.row->live)->unready};
}

std::variant<Devices, DeviceFailure> open_devices(const DeviceSpec& camera, const DeviceSpec& odometry,
                                                  const host::RobotFile& robot, linux::MonotonicClock clock,
                                                  bool wait) {
  try {
    refuse_one_port_twice(camera, odometry);
    Devices devices;
    const OdometryDriver& wheels = odometry_driver(odometry);
    const std::shared_ptr<host::SharedBrick> brick = wheels.brick != nullptr ? wheels.brick(odometry, wait) : nullptr;
    devices.odometry = (*wheels.open)({odometry, robot, brick, clock, wait});
    devices.camera = (*camera_driver(camera).open)({camera, robot, brick, clock, wait});
    devices.camera->introduce(label_of(camera));
    devices.odometry->introduce(label_of(odometry));
    devices.intrinsics = intrinsics_of(camera, robot);
    return devices;
  } catch (DeviceFailure& failure) {
    return std::move(failure);
  }
}

}  // namespace fencepost::devices
