#include "host/live/open_camera.hpp"

#include "drivers/cmucam/cmucam.hpp"
#include "drivers/nxt/sensor_port.hpp"
#include "drivers/nxtcam/camera.hpp"
#include "drivers/nxtcam/serial_camera.hpp"
#include "drivers/nxtcam/v5_camera.hpp"
#include "drivers/pixy2/camera.hpp"
#include "drivers/pixy2/chirp_link.hpp"
#include "drivers/wire/i2c_stream.hpp"
#include "drivers/xbc/xbc.hpp"
#include "host/live/open_port.hpp"

namespace fencepost::host {
namespace {

using base::milliseconds;
using Camera = std::unique_ptr<CameraDevice>;

/// A camera that is asked has its next question when its answer is there: then the loop turns at once.
constexpr base::Duration kAsked = milliseconds(4);
/// Nothing wakes the loop: the device has to be looked at.
constexpr base::Duration kLookedAt = milliseconds(2);

constexpr std::uint8_t kPixyAddress = 0x54;  // 7 bits, Pixy2 documentation, porting guide
constexpr std::uint32_t kPixyBaud = 19'200;  // as delivered
constexpr std::uint32_t kCmuCam4Baud = 19'200;
constexpr std::uint32_t kXbcBaud = 38'400;
constexpr std::uint32_t kUsualBaud = 115'200;

template <class Driver>
struct Serial {
  template <class... Arguments>
  explicit Serial(std::unique_ptr<BytePort> port, Arguments&&... arguments)
      : line(std::move(port)), driver(*line, std::forward<Arguments>(arguments)...) {}
  [[nodiscard]] Port& port() const { return *line; }

  std::unique_ptr<BytePort> line;
  Driver driver;
};

struct PixyOnI2c {
  PixyOnI2c(std::unique_ptr<I2cPort> port, std::uint8_t address) : bus(std::move(port)), stream(*bus, address) {}
  [[nodiscard]] Port& port() const { return *bus; }

  std::unique_ptr<I2cPort> bus;
  wire::I2cStream<I2cPort> stream;
  pixy2::Camera<wire::I2cStream<I2cPort>> driver{stream};
};

struct PixyOnUsb {
  explicit PixyOnUsb(std::unique_ptr<BytePort> port) : pipe(std::move(port)) {}
  [[nodiscard]] Port& port() const { return *pipe; }

  std::unique_ptr<BytePort> pipe;
  pixy2::ChirpLink<BytePort> chirp{*pipe};
  pixy2::Camera<pixy2::ChirpLink<BytePort>> driver{chirp};
};

struct NxtCamOnI2c {
  NxtCamOnI2c(std::unique_ptr<I2cPort> port, const nxtcam::Options& options, std::uint8_t address)
      : bus(std::move(port)), driver(*bus, options, address) {}
  [[nodiscard]] Port& port() const { return *bus; }

  std::unique_ptr<I2cPort> bus;
  nxtcam::Camera<I2cPort> driver;
};

/// The brick's port is the odometry's to tend.
class NxtCamBehindBrick final : public CameraDevice {
 public:
  NxtCamBehindBrick(std::shared_ptr<BrickStation> brick, std::uint8_t port, const nxtcam::Options& options,
                    std::uint8_t address)
      : brick_(std::move(brick)), port_(brick_->conversation(), port), camera_(port_, options, address) {}

  base::Result<sensor::BlobFrame> poll(base::Time now) override { return camera_.poll(now); }
  [[nodiscard]] std::uint32_t dropped() const override { return camera_.dropped(); }
  [[nodiscard]] sensor::LinkState link() const override {
    return brick_->port().connected() ? camera_.link() : sensor::LinkState::kAbsent;
  }
  [[nodiscard]] std::string problem() const override { return brick_->port().problem(); }
  [[nodiscard]] base::Duration patience() const override { return patience_with(brick_->port(), kAsked); }

 private:
  std::shared_ptr<BrickStation> brick_;
  nxt::SensorPort port_;
  nxtcam::Camera<nxt::SensorPort> camera_;
};

template <class Driver, class... Arguments>
Camera on_line(const DeviceSpec& spec, std::uint32_t baud, bool wait, Arguments&&... arguments) {
  return std::make_unique<PortedCamera<Serial<Driver>>>(kAsked, open_byte_port(spec, baud, wait),
                                                        std::forward<Arguments>(arguments)...);
}

Camera open_pixy(const DeviceSpec& spec, bool wait) {
  if (spec.place.kind == PlaceKind::kI2c) {
    const auto address = static_cast<std::uint8_t>(spec.number("address", kPixyAddress));
    return std::make_unique<PortedCamera<PixyOnI2c>>(kLookedAt, open_i2c_port(spec, wait), address);
  }
  if (spec.place.kind == PlaceKind::kUsb) {
    return std::make_unique<PortedCamera<PixyOnUsb>>(kAsked, open_byte_port(spec, kPixyBaud, wait));
  }
  const base::Duration patience = spec.place.kind == PlaceKind::kSpi ? kLookedAt : kAsked;
  using Stack = Serial<pixy2::Camera<BytePort>>;
  return std::make_unique<PortedCamera<Stack>>(patience, open_byte_port(spec, kPixyBaud, wait));
}

const cmucam::Dialect& dialect_of(const DeviceSpec& spec) {
  const bool high = spec.option("resolution", "low") == "high";
  switch (spec.kind) {
    case DeviceKind::kCmuCam1: return cmucam::kCmuCam1;
    case DeviceKind::kCmuCam3: return high ? cmucam::kCmuCam3High : cmucam::kCmuCam3;
    case DeviceKind::kCmuCam4: return cmucam::kCmuCam4;
    default: break;
  }
  if (spec.option("imager", "ov6620") == "ov7620") return cmucam::kCmuCam2Ov7620;
  return high ? cmucam::kCmuCam2High : cmucam::kCmuCam2;
}

Camera open_cmucam(const DeviceSpec& spec, const RobotFile& robot, bool wait) {
  if (robot.windows.empty()) {
    throw DeviceFailure{true, spec.where() +
                                  " tracks no colour yet: name them in a --robot file, for example "
                                  "{\"signatures\": [{\"id\": 1, \"name\": \"red\", \"rgb\": \"d02020\"}]}"};
  }
  cmucam::Config config;
  config.dialect = &dialect_of(spec);
  for (const cmucam::ColourWindow& window : robot.windows) static_cast<void>(config.windows.push_back(window));
  config.settle = milliseconds(1'000 * static_cast<std::int64_t>(spec.number("settle", 5)));
  const std::uint32_t baud = spec.kind == DeviceKind::kCmuCam4 ? kCmuCam4Baud : kUsualBaud;
  return on_line<cmucam::CmuCam<BytePort>>(spec, baud, wait, config);
}

Camera open_nxtcam(const DeviceSpec& spec, const std::shared_ptr<BrickStation>& brick, bool wait) {
  nxtcam::Options options;
  options.check_colour_map = spec.option("map", "on") == "on";
  options.lock_buffer = spec.option("lock", "off") == "on";
  const auto address = static_cast<std::uint8_t>(spec.number("address", nxtcam::kDefaultAddress));
  if (spec.place.kind == PlaceKind::kI2c) {
    return std::make_unique<PortedCamera<NxtCamOnI2c>>(kLookedAt, open_i2c_port(spec, wait), options, address);
  }
  if (spec.place.kind != PlaceKind::kNxt) return on_line<nxtcam::SerialCamera<BytePort>>(spec, kUsualBaud, wait);
  if (!brick) {
    throw DeviceFailure{true,
                        "nxtcam:nxt is plugged into the NXT brick that is the odometry too; add --odometry "
                        "nxt:usb, or nxt:/dev/rfcomm0"};
  }
  const auto port = static_cast<std::uint8_t>(spec.number("port", 1) - 1);
  return std::make_unique<NxtCamBehindBrick>(brick, port, options, address);
}

Camera open_nxtcam5(const DeviceSpec& spec, bool wait) {
  nxtcam::V5Options options;
  options.silence_is_empty = spec.option("silence", "lost") == "empty";
  return on_line<nxtcam::V5Camera<BytePort>>(spec, kUsualBaud, wait, options);
}

}  // namespace

Camera open_camera(const DeviceSpec& spec, const RobotFile& robot, const std::shared_ptr<BrickStation>& brick,
                   bool wait) {
  switch (spec.kind) {
    case DeviceKind::kPixy2:
    case DeviceKind::kPixy21: return open_pixy(spec, wait);
    case DeviceKind::kCmuCam1:
    case DeviceKind::kCmuCam2:
    case DeviceKind::kCmuCam3:
    case DeviceKind::kCmuCam4: return open_cmucam(spec, robot, wait);
    case DeviceKind::kNxtCam: return open_nxtcam(spec, brick, wait);
    case DeviceKind::kNxtCam5: return open_nxtcam5(spec, wait);
    case DeviceKind::kAvrCam: return on_line<nxtcam::SerialCamera<BytePort>>(spec, kUsualBaud, wait);
    case DeviceKind::kXbc: return on_line<xbc::Xbc<BytePort>>(spec, kXbcBaud, wait, xbc::Config{});
    default: return std::make_unique<ConsoleCamera>();
  }
}

std::optional<sensor::CameraIntrinsics> profile_of(const DeviceSpec& spec) {
  switch (spec.kind) {
    case DeviceKind::kPixy2: return pixy2::kPixy2Profile;
    case DeviceKind::kPixy21: return pixy2::kPixy21Profile;
    case DeviceKind::kCmuCam1:
    case DeviceKind::kCmuCam2:
    case DeviceKind::kCmuCam3:
    case DeviceKind::kCmuCam4: return cmucam::nominal_intrinsics(dialect_of(spec), {});
    case DeviceKind::kNxtCam: return nxtcam::kProfile;
    case DeviceKind::kNxtCam5: return nxtcam::kV5Profile;
    case DeviceKind::kAvrCam: {
      sensor::CameraIntrinsics profile = nxtcam::kProfile;
      profile.model = "avrcam";
      return profile;
    }
    case DeviceKind::kXbc: return xbc::nominal_intrinsics({});
    default: return std::nullopt;
  }
}

}  // namespace fencepost::host
