// The LEGO NXT brick: its motors, and for `emulate` an NXTCam on one of its sensor ports.
#include "drivers/nxt/tacho_odometry.hpp"

#include "drivers/nxtcam/camera.hpp"
#include "drivers/odometry/wheel_base.hpp"
#include "hal/linux/usb_settings.hpp"
#include "host/devices/options.hpp"
#include "host/devices/ported.hpp"

namespace fencepost::devices {

Rows nxt();

namespace {

using enum PlaceKind;

constexpr std::uint32_t kBluetoothBaud = 115'200;  // has no effect on a Bluetooth serial port
// The wheel and the track of the set's first robot.
constexpr emulate::WheelShape kNxtWheels{metres(odometry::per_count({56.0, 360.0})), 0.112};

class BrickOdometry final : public host::OdometryDevice {
 public:
  BrickOdometry(std::shared_ptr<host::SharedBrick> brick, const nxt::TachoOptions& options)
      : brick_(std::move(brick)), tacho_(brick_->conversation(), options) {}

  base::Result<sensor::OdometrySample> poll(base::Time now) override {
    brick_->poll(now);
    return tacho_.poll(now);
  }
  [[nodiscard]] sensor::LinkState link() const override {
    return brick_->port().connected() ? tacho_.link() : sensor::LinkState::kAbsent;
  }
  void tend(base::Time now) override { brick_->port().tend(now); }
  void watch(linux::WaitSet& set) const override { set.add_readable(brick_->port().descriptor()); }
  [[nodiscard]] std::string problem() const override { return brick_->port().problem(); }
  [[nodiscard]] base::Duration patience() const override { return host::patience_with(brick_->port(), kAsked); }

 private:
  std::shared_ptr<host::SharedBrick> brick_;
  nxt::TachoOdometry tacho_;
};

std::shared_ptr<host::SharedBrick> open_brick(const DeviceSpec& spec, bool wait) {
  const host::PortRequest request{spec.kind_name(), wait};
  if (spec.place.kind == kUsb) {
    return std::make_shared<host::UsbBrick>(host::open_brick_port(spec.option("serial"), request));
  }
  return std::make_shared<host::SerialBrick>(host::open_line(spec.place, spec.number("baud"), request));
}

std::unique_ptr<host::OdometryDevice> open_nxt(const Opening& opening) {
  nxt::TachoOptions options;
  options.left_port = static_cast<std::uint8_t>(opening.spec.option("left").front() - 'A');
  options.right_port = static_cast<std::uint8_t>(opening.spec.option("right").front() - 'A');
  if (options.left_port == options.right_port) {
    throw host::DeviceFailure{true,
                              opening.spec.where() + ": left and right are the same motor; give left= and right="};
  }
  options.wheels = opening.robot.wheels.over(options.wheels);
  return std::make_unique<BrickOdometry>(opening.brick, options);
}

emulate::WheelShape wheels(const DeviceSpec& spec) { return {spec.real("tick"), spec.real("track")}; }

Emulated brick() {
  return {.tells = "degrees of motors B (left) and C",
          .options = wheel_options(0, kNxtWheels),
          .describe = emulate::describe_nxt,
          .make = [](const DeviceSpec& spec,
                     const emulate::Colours&) { return emulate::make_nxt_model(wheels(spec), std::nullopt); },
          .asked = true,
          .wheels = kNxtWheels};
}

Emulated brick_with_camera() {
  Emulated with = brick();
  std::vector<Option>& options = with.options;
  options.push_back({"port", Whole{1, 4}, "1", "of the brick"});
  with.tells = "an NXTCam on the brick's sensor port";
  with.make = [](const DeviceSpec& spec, const emulate::Colours&) {
    return emulate::make_nxt_model(wheels(spec), static_cast<int>(spec.number("port")));
  };
  with.image = image_of(nxtcam::kProfile, {8, 8, 0, 7}, 30);
  with.label = "nxt";
  return with;
}

}  // namespace

Rows nxt() {
  const Words motors{{"A", "B", "C"}};
  Row brick_alone = {
      .name = "nxt",
      .about = "LEGO NXT, its motors",
      .role = Role::kOdometry,
      .live = Live{.places = {kUsb, kTty, kTcp},
                   .options = {baud(kBluetoothBaud), serial(), {"left", motors, "B"}, {"right", motors, "C"}},
                   .unready = "its motors do not answer: check left= and right=",
                   .driver = OdometryDriver{open_nxt, open_brick}},
      .emulated = brick(),
      .tried = {{kUsb, "nxt:usb", "RunOnNxt.SeesAPostWhereItIs"},
                {kTty, "", "", "nxt-python: motors, battery, firmware, sensors"}}};
  Row with_camera = {.name = "nxtcam:nxt",
                     .about = "LEGO NXT with an NXTCam",
                     .role = Role::kOdometry,
                     .live = std::nullopt,
                     .emulated = brick_with_camera()};
  brick_alone.usb = UsbIds{linux::kNxtUsb.vendor, linux::kNxtUsb.product};
  return {brick_alone, with_camera};
}

}  // namespace fencepost::devices
