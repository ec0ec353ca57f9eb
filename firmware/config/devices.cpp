#include "firmware/config/devices.hpp"

#include "firmware/record/decimal.hpp"
#include "hal/base/trig.hpp"

namespace fencepost::config {
namespace {

base::Pixels2 scaled(base::Pixels2 length, float by) {
  return {static_cast<std::int32_t>(static_cast<float>(length.raw) * by + 0.5F)};
}

// No lens keeps straight lines straight beyond: it is a fisheye.
constexpr std::int32_t kWidestPinhole = 100;  // degrees across

// fx = (width / 2) / tan(fov / 2); of a fisheye fx = (width / 2) / (fov / 2).
void put_lens(sensor::CameraIntrinsics& camera, std::int32_t degrees) {
  constexpr std::int64_t kHalfDegree = 8'727;  // urad: pi / 360
  constexpr float kHalfPerColumn = 50;         // hundredths of a pixel
  const base::SinCos half = base::sincos_urad(degrees * kHalfDegree);
  const bool fisheye = degrees > kWidestPinhole;
  if (fisheye) camera.lens = sensor::Lens::kEquidistant;
  const float one = static_cast<float>(camera.width) * kHalfPerColumn;
  const float fx = fisheye ? one / (1e-6F * static_cast<float>(degrees * kHalfDegree)) : one * half.cos / half.sin;
  const float by = fx / static_cast<float>(camera.fx.raw);
  camera.fy = scaled(camera.fy, by);
  camera.fx = scaled(camera.fx, by);
}

}  // namespace

sensor::CameraIntrinsics delivered_calibration(CameraId id) {
  // NOLINTBEGIN(bugprone-branch-clone): a camera on two wires has the same lens
  switch (id) {
#define FENCEPOST_CALIBRATION(id, name, port, speed, address, calibration) \
  case CameraId::id: return calibration;
    FENCEPOST_CAMERAS(FENCEPOST_CALIBRATION)
#undef FENCEPOST_CALIBRATION
  }
  // NOLINTEND(bugprone-branch-clone)
  return {};
}

std::size_t device_key_named(std::string_view name) {
  std::size_t index = 0;
  while (index < kDeviceKeys && kDeviceInfo[index].name != name) ++index;
  return index;
}

std::optional<SettingError> Devices::set(std::string_view key, std::string_view value) {
  const std::size_t index = device_key_named(key);
  if (index == kDeviceKeys) return SettingError::kUnknownKey;
  const KeyInfo& entry = kDeviceInfo[index];
  if (entry.unit == kDeviceName) {
    const bool camera = static_cast<DeviceKey>(index) == DeviceKey::kCamera;
    const std::size_t device =
        camera ? static_cast<std::size_t>(camera_named(value)) : static_cast<std::size_t>(odometry_named(value));
    if (device == (camera ? kCameraIds : kOdometryIds)) return SettingError::kOutOfRange;
    values_[index] = static_cast<std::int32_t>(device);
    return std::nullopt;
  }
  const auto number = record::read_decimal(value, {entry.low, entry.high, static_cast<std::uint8_t>(entry.decimals)});
  if (!number) {
    return number.error() == record::Reject::kRange ? SettingError::kOutOfRange : SettingError::kNotANumber;
  }
  values_[index] = static_cast<std::int32_t>(*number);
  return std::nullopt;
}

sensor::Text Devices::text(DeviceKey key) const {
  if (key == DeviceKey::kCamera) return info(camera()).name;
  if (key == DeviceKey::kOdometry) return info(odometry()).name;
  std::array<char, record::kMaxDecimal> digits{};
  const std::size_t size = record::write_decimal(raw(key), static_cast<unsigned>(info(key).decimals), digits);
  return std::string_view{digits.data(), size};
}

sensor::CameraIntrinsics Devices::calibration() const {
  sensor::CameraIntrinsics camera_as_delivered = delivered_calibration(camera());
  const std::int32_t degrees = raw(DeviceKey::kLens);
  if (degrees != 0 && camera_as_delivered.width > 0) put_lens(camera_as_delivered, degrees);
  return camera_as_delivered;
}

// With integers, for the smallest parts have no doubles. Within a picometre of odometry::make_wheel_base.
odometry::WheelBase Devices::wheels(int counter_bits) const {
  constexpr std::int64_t kPi = 3'141'592'654;  // 10^-9
  constexpr std::int64_t kPicometresPerTenth = 100'000'000;
  const std::int64_t rim_of_ten = kPi * raw(DeviceKey::kWheelDiameter);  // pm, of ten wheels
  const std::int64_t counts = raw(DeviceKey::kWheelCounts);              // of ten turns
  const std::int64_t half = (counts < 0 ? -counts : counts) / 2;
  odometry::WheelBase base;
  base.left_pm_per_count = base.right_pm_per_count = (rim_of_ten + half) / counts;
  base.track_pm = kPicometresPerTenth * raw(DeviceKey::kWheelTrack);
  base.counter_bits = counter_bits;
  return base;
}

std::string_view reason(Refusal refusal) {
  switch (refusal) {
    case Refusal::kNone: return {};
    case Refusal::kCameraNotInImage: return "the image of this board does not contain that camera";
    case Refusal::kOdometryNotInImage: return "the image of this board does not contain that odometry";
    case Refusal::kOneLine:
      return "camera and wheel base would share the board's one serial line beside the console; take a camera on the "
             "two-wire bus, such as pixy2_i2c";
    case Refusal::kAddress:
      return "this part's two-wire bus does not speak to addresses 0 to 7, and an NXTCam has 1; connect its serial "
             "pins, camera nxtcam";
    case Refusal::kNoLens: return "$FPCAM gives the lens of a camera behind the console; lens has to be 0";
    case Refusal::kNoCounts: return "a wheel has counts; 0 is none";
    case Refusal::kNoMotors:
      return "no motor of this board's robot is driven by its own program; its STOP pin goes to a motor driver, or "
             "take "
             "a Pico or an XRP";
  }
  return {};
}

}  // namespace fencepost::config
