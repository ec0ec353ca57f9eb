// The cameras and wheels that a board's image can have, and the settings that choose among them. The one table: `set
// camera` on the robot and `fencepost configure` on the desk both read it, and both refuse what it refuses.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "drivers/odometry/wheel_base.hpp"
#include "firmware/config/cameras.hpp"
#include "firmware/config/settings.hpp"
#include "hal/bus/pin_names.hpp"
#include "hal/sensor/camera.hpp"

namespace fencepost::config {

/// Where a device is connected.
enum class Port : std::uint8_t { kConsole, kLine, kTwoWire, kPins };

#define FENCEPOST_ID(id, name, port, speed, address, calibration) id,
enum class CameraId : std::uint8_t { FENCEPOST_CAMERAS(FENCEPOST_ID) };
#undef FENCEPOST_ID

enum class OdometryId : std::uint8_t { kConsole, kEncoders, kCreate1, kCreate2 };
inline constexpr std::size_t kOdometryIds = 4;

struct DeviceInfo {
  std::string_view name;
  Port port = Port::kConsole;
  std::uint32_t speed = 0;   ///< of a line, baud
  std::uint8_t address = 0;  ///< on the two-wire bus
};

#define FENCEPOST_ONE(id, name, port, speed, address, calibration) +1
inline constexpr std::size_t kCameraIds = 0 FENCEPOST_CAMERAS(FENCEPOST_ONE);
#undef FENCEPOST_ONE
/// By CameraId. With its length: GCC 12 puts an array of a deduced type into RAM.
#define FENCEPOST_INFO(id, name, port, speed, address, calibration) {name, Port::port, speed, address},
inline constexpr std::array<DeviceInfo, kCameraIds> kCameras = {{FENCEPOST_CAMERAS(FENCEPOST_INFO)}};
#undef FENCEPOST_INFO
/// By OdometryId.
inline constexpr std::array<DeviceInfo, kOdometryIds> kOdometries = {{
    {"console"},
    {"encoders", Port::kPins},
    {"create1", Port::kLine, 57'600},
    {"create2", Port::kLine, 115'200},
}};

constexpr const DeviceInfo& info(CameraId id) { return kCameras[static_cast<std::size_t>(id)]; }
constexpr const DeviceInfo& info(OdometryId id) { return kOdometries[static_cast<std::size_t>(id)]; }

/// A name that is none gives what no image contains.
constexpr CameraId camera_named(std::string_view name) {
  std::size_t index = 0;
  while (index < kCameraIds && kCameras[index].name != name) ++index;
  return static_cast<CameraId>(index);
}
constexpr OdometryId odometry_named(std::string_view name) {
  std::size_t index = 0;
  while (index < kOdometryIds && kOdometries[index].name != name) ++index;
  return static_cast<OdometryId>(index);
}

/// Resolution, lens and latency as the camera's maker says them; a width of 0 where nothing is known until $FPCAM.
sensor::CameraIntrinsics delivered_calibration(CameraId id);

enum class DeviceKey : std::uint8_t {
  kCamera,
  kLens,
  kOdometry,
  kWheelDiameter,
  kWheelCounts,
  kWheelTrack,
  kDrive,
  kBumper,
};
inline constexpr std::size_t kDeviceKeys = 8;

/// The unit of settings whose value is a device's name.
inline constexpr std::string_view kDeviceName = "name";

/// By DeviceKey. These are the defaults of an image that has no others.
inline constexpr std::array<KeyInfo, kDeviceKeys> kDeviceInfo = {{
    {"camera", kDeviceName, 0, 0, 0, kCameraIds - 1, "the camera that is connected"},
    {"lens", "deg", 0, 0, 0, 150, "what it sees across; 0: as it is delivered"},
    {"odometry", kDeviceName, 0, 0, 0, kOdometryIds - 1, "what tells how the wheels turn"},
    {"wheel.diameter", "mm", 1, 650, 10, 10'000, "of wheels with encoders"},
    {"wheel.counts", "", 1, 14'400, -1'000'000, 1'000'000, "a turn, four a period; negative: backwards"},
    {"wheel.track", "mm", 1, 1'300, 10, 20'000, "between the wheels' middles"},
    {"drive", "mm/s", 0, 0, 0, 500, "a Create straight on while it may; 0: never"},
    {"bumper", "%", 0, 0, 0, 90, "of the motors' power after `go`; 0: never"},
}};
constexpr const KeyInfo& info(DeviceKey key) { return kDeviceInfo[static_cast<std::size_t>(key)]; }
/// The index of the setting with that name; kDeviceKeys if there is none.
std::size_t device_key_named(std::string_view name);

/// The settings in force, as numbers by DeviceKey; a device's number is its id.
class Devices {
 public:
  constexpr Devices() {
    for (std::size_t i = 0; i < kDeviceKeys; ++i) values_[i] = kDeviceInfo[i].initial;
  }
  constexpr Devices(CameraId camera, OdometryId odometry) : Devices() {
    put(DeviceKey::kCamera, static_cast<std::int32_t>(camera));
    put(DeviceKey::kOdometry, static_cast<std::int32_t>(odometry));
  }

  [[nodiscard]] constexpr std::int32_t raw(DeviceKey key) const { return values_[static_cast<std::size_t>(key)]; }
  constexpr void put(DeviceKey key, std::int32_t raw) { values_[static_cast<std::size_t>(key)] = raw; }
  [[nodiscard]] constexpr CameraId camera() const { return static_cast<CameraId>(raw(DeviceKey::kCamera)); }
  [[nodiscard]] constexpr OdometryId odometry() const { return static_cast<OdometryId>(raw(DeviceKey::kOdometry)); }

  /// Takes `value` as written on the console. Nothing changes on an error.
  std::optional<SettingError> set(std::string_view key, std::string_view value);
  /// As `get` writes it.
  [[nodiscard]] sensor::Text text(DeviceKey key) const;

  /// The camera's, through its lens; where the camera is mounted is not part of it.
  [[nodiscard]] sensor::CameraIntrinsics calibration() const;
  /// The wheel base, for encoders with this many bits.
  [[nodiscard]] odometry::WheelBase wheels(int counter_bits) const;

  friend constexpr bool operator==(const Devices&, const Devices&) = default;

 private:
  std::array<std::int32_t, kDeviceKeys> values_{};
};

/// The contents of an image, and the abilities of its board.
struct DeviceLimits {
  std::uint32_t cameras = 0;        ///< bit n: CameraId n
  std::uint32_t odometries = 0;     ///< bit n: OdometryId n
  bool one_line = false;            ///< camera and wheel base would share it
  std::uint8_t lowest_address = 0;  ///< that the two-wire bus can speak to
  bool motors = false;              ///< the board drives two by itself
  Devices initial;                  ///< of an image without any setting

  [[nodiscard]] constexpr bool contains(CameraId id) const { return (cameras >> static_cast<unsigned>(id) & 1U) != 0; }
  [[nodiscard]] constexpr bool contains(OdometryId id) const {
    return (odometries >> static_cast<unsigned>(id) & 1U) != 0;
  }
};

enum class Refusal : std::uint8_t {
  kNone,
  kCameraNotInImage,
  kOdometryNotInImage,
  kOneLine,
  kAddress,
  kNoLens,
  kNoCounts,
  kNoMotors,
};

constexpr Refusal refusal(const Devices& devices, const DeviceLimits& limits) {
  if (!limits.contains(devices.camera())) return Refusal::kCameraNotInImage;
  if (!limits.contains(devices.odometry())) return Refusal::kOdometryNotInImage;
  const DeviceInfo& camera = info(devices.camera());
  const bool both = camera.port == Port::kLine && info(devices.odometry()).port == Port::kLine;
  if (limits.one_line && both) return Refusal::kOneLine;
  if (camera.port == Port::kTwoWire && camera.address < limits.lowest_address) return Refusal::kAddress;
  if (devices.camera() == CameraId::kConsole && devices.raw(DeviceKey::kLens) != 0) return Refusal::kNoLens;
  if (devices.raw(DeviceKey::kWheelCounts) == 0) return Refusal::kNoCounts;
  if (!limits.motors && devices.raw(DeviceKey::kBumper) != 0) return Refusal::kNoMotors;
  return Refusal::kNone;
}
/// Why, and what to do instead.
std::string_view reason(Refusal refusal);

/// The devices that a robot's program offers to its console, which borrows this.
struct DeviceOffer {
  DeviceLimits limits;
  bus::PinNames pins;
};

}  // namespace fencepost::config
