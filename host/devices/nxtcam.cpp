// NXTCam on its bus, behind an NXT brick or on its serial line; NXTCam v5 and AVRcam.
#include "drivers/nxt/sensor_port.hpp"
#include "drivers/nxtcam/camera.hpp"
#include "drivers/nxtcam/serial_camera.hpp"
#include "drivers/nxtcam/v5_camera.hpp"
#include "host/devices/options.hpp"
#include "host/devices/ported.hpp"
#include "host/emulate/models/camera_adapters.hpp"

namespace fencepost::devices {

Rows nxtcam();

namespace {

using enum PlaceKind;
using Camera = std::unique_ptr<host::CameraDevice>;

constexpr std::uint32_t kNxtcamBaud = 115'200;
constexpr const char* kViewer = "aNXTCam";
constexpr const char* kTeach = "teach it colours with the maker's program";

struct NxtcamOnI2c {
  NxtcamOnI2c(std::unique_ptr<host::I2cPort> port, const nxtcam::Options& options, std::uint8_t address)
      : bus(std::move(port)), driver(*bus, options, address) {}
  [[nodiscard]] host::Port& port() const { return *bus; }

  std::unique_ptr<host::I2cPort> bus;
  nxtcam::Camera<host::I2cPort> driver;
};

/// The brick's port is the odometry's to tend.
class BehindBrick final : public host::CameraDevice {
 public:
  BehindBrick(std::shared_ptr<host::SharedBrick> brick, std::uint8_t port, const nxtcam::Options& options,
              std::uint8_t address)
      : brick_(std::move(brick)), port_(brick_->conversation(), port), camera_(port_, options, address) {}

  base::Result<sensor::BlobFrame> poll(base::Time now) override { return camera_.poll(now); }
  [[nodiscard]] std::uint32_t dropped() const override { return camera_.dropped(); }
  [[nodiscard]] sensor::LinkState link() const override {
    return brick_->port().connected() ? camera_.link() : sensor::LinkState::kAbsent;
  }
  [[nodiscard]] std::string problem() const override { return brick_->port().problem(); }
  [[nodiscard]] base::Duration patience() const override { return host::patience_with(brick_->port(), kAsked); }

 private:
  std::shared_ptr<host::SharedBrick> brick_;
  nxt::SensorPort port_;
  nxtcam::Camera<nxt::SensorPort> camera_;
};

Camera open_nxtcam(const Opening& opening) {
  const DeviceSpec& spec = opening.spec;
  if (spec.place.kind == kTty || spec.place.kind == kTcp) {
    return camera_on_line<nxtcam::SerialCamera<host::BytePort>>(opening);
  }
  nxtcam::Options options;
  options.check_colour_map = spec.option("map") == "on";
  options.lock_buffer = spec.option("lock") == "on";
  const auto address = static_cast<std::uint8_t>(spec.number("address"));
  if (spec.place.kind == kI2c) {
    return std::make_unique<host::PortedCamera<NxtcamOnI2c>>(kLookedAt, host::open_i2c(spec.place.name, opening.port()),
                                                             options, address);
  }
  if (!opening.brick) {
    throw host::DeviceFailure{true,
                              "nxtcam:nxt is plugged into the NXT brick that is the odometry too; add --odometry "
                              "nxt:usb, or nxt:/dev/rfcomm0"};
  }
  const auto port = static_cast<std::uint8_t>(spec.number("port") - 1);
  return std::make_unique<BehindBrick>(opening.brick, port, options, address);
}

Camera open_v5(const Opening& opening) {
  nxtcam::V5Options options;
  options.silence_is_empty = opening.spec.option("silence") == "empty";
  return camera_on_line<nxtcam::V5Camera<host::BytePort>>(opening, options);
}

Camera open_avrcam(const Opening& opening) { return camera_on_line<nxtcam::SerialCamera<host::BytePort>>(opening); }

std::optional<sensor::CameraIntrinsics> nxtcam_profile(const DeviceSpec& /*spec*/) { return nxtcam::kProfile; }
std::optional<sensor::CameraIntrinsics> v5_profile(const DeviceSpec& /*spec*/) { return nxtcam::kV5Profile; }
std::optional<sensor::CameraIntrinsics> avrcam_profile(const DeviceSpec& /*spec*/) {
  sensor::CameraIntrinsics profile = nxtcam::kProfile;
  profile.model = "avrcam";
  return profile;
}

Emulated avrcam_dialect() {
  return {.tells = "even columns",
          .options = {line_baud(kNxtcamBaud)},
          .describe = emulate::describe_avrcam,
          .make = [](const DeviceSpec&, const emulate::Colours&) { return emulate::make_nxtcam_model(); },
          .image = image_of(nxtcam::kProfile, {8, 8, 0, 7}, 30)};
}

}  // namespace

Rows nxtcam() {
  Row on_bus = {
      .name = "nxtcam",
      .about = "NXTCam v1 to v4; v5 over I2C",
      .role = Role::kCamera,
      .live = Live{.places = {kI2c, kNxt, kTty, kTcp},
                   .options = {baud(kNxtcamBaud),
                               address(nxtcam::kDefaultAddress, {kI2c, kNxt}),
                               {"port", Whole{1, 4}, "1", "of the brick", {kNxt}},
                               {"map", Words{{"on", "off"}}, "on", "check of the colour map", {kI2c, kNxt}},
                               {"lock", Words{{"off", "on"}}, "off", "of the buffer, later v4", {kI2c, kNxt}}},
                   .unready = kTeach,
                   .driver = CameraDriver{open_nxtcam, nxtcam_profile,
                                          "published: 43 degrees, often said; its user guides tell none"}},
      .emulated = avrcam_dialect(),
      .images = {"nxtcam", "nxtcam_i2c"},
      .tried = {{kI2c, "nxtcam:i2c", "RunOnCamera.NxtCamOnI2c"},
                {kNxt, "nxtcam:nxt (usb)", "RunOnNxt.SeesAPostWhereItIs"},
                {kTty, "", "", kViewer}}};
  Row v5 = {
      .name = "nxtcam5",
      .about = "the line inside an NXTCam v5",
      .role = Role::kCamera,
      .live =
          Live{.places = {kTty, kTcp},
               .options = {baud(kNxtcamBaud),
                           {"silence", Words{{"lost", "empty"}}, "lost", "what it means if nothing comes at all"}},
               .unready = kTeach,
               .driver = CameraDriver{open_v5, v5_profile, "assumed: that of the OpenMV it is built on, 70.8 degrees"}},
      .emulated =
          Emulated{.tells = "nothing for an image without blobs",
                   .options = {line_baud(kNxtcamBaud)},
                   .describe = emulate::describe_nxtcam5,
                   .make = [](const DeviceSpec&, const emulate::Colours&) { return emulate::make_nxtcam5_model(); },
                   .image = image_of(nxtcam::kV5Profile, {}, 30)}};
  Row avrcam = {
      .name = "avrcam",
      .about = "AVRcam",
      .role = Role::kCamera,
      .live = Live{.places = {kTty, kTcp},
                   .options = {baud(kNxtcamBaud)},
                   .unready = kTeach,
                   .driver = CameraDriver{open_avrcam, avrcam_profile, "assumed: as the NXTCam, which is an AVRcam"}},
      .emulated = avrcam_dialect(),
      .tried = {{.others = kViewer}}};
  return {on_bus, v5, avrcam};
}

}  // namespace fencepost::devices
