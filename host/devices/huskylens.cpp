// HuskyLens 1.
#include "drivers/huskylens/huskylens.hpp"

#include "drivers/wire/i2c_stream.hpp"
#include "host/devices/options.hpp"
#include "host/devices/ported.hpp"
#include "host/emulate/models/huskylens.hpp"

namespace fencepost::devices {

Rows huskylens();

namespace {

using enum PlaceKind;

constexpr std::uint32_t kHuskylensBaud = 9'600;

struct HuskylensOnI2c {
  HuskylensOnI2c(std::unique_ptr<host::I2cPort> port, std::uint8_t address)
      : bus(std::move(port)), stream(*bus, address) {}
  [[nodiscard]] host::Port& port() const { return *bus; }

  std::unique_ptr<host::I2cPort> bus;
  wire::I2cStream<host::I2cPort> stream;
  huskylens::Camera<wire::I2cStream<host::I2cPort>> driver{stream};
};

std::unique_ptr<host::CameraDevice> open_huskylens(const Opening& opening) {
  if (opening.spec.place.kind != kI2c) return camera_on_line<huskylens::Camera<host::BytePort>>(opening);
  const auto address = static_cast<std::uint8_t>(opening.spec.number("address"));
  return std::make_unique<host::PortedCamera<HuskylensOnI2c>>(
      kLookedAt, host::open_i2c(opening.spec.place.name, opening.port()), address);
}

std::optional<sensor::CameraIntrinsics> huskylens_profile(const DeviceSpec& /*spec*/) { return huskylens::kProfile; }

}  // namespace

Rows huskylens() {
  return {{.name = "huskylens",
           .about = "HuskyLens 1; its lens is a guess: calibrate",
           .role = Role::kCamera,
           .live = Live{.places = {kTty, kTcp, kI2c},
                        .options = {baud(kHuskylensBaud), address(huskylens::kAddress)},
                        .unready = "it has learned no colour, is busy, or shows a menu",
                        .driver = CameraDriver{open_huskylens, huskylens_profile}},
           .emulated = Emulated{.tells = "blocks of learned colours; no arrows",
                                .options = {line_baud(kHuskylensBaud)},
                                .describe = emulate::describe_huskylens,
                                .make = [](const DeviceSpec&,
                                           const emulate::Colours&) -> std::unique_ptr<emulate::DeviceModel> {
                                  return std::make_unique<emulate::HuskyLens>();
                                },
                                .image = image_of(huskylens::kProfile, {.first_signature = 1}, 30),
                                .asked = true},
           .images = {"huskylens", "huskylens_i2c"}}};
}

}  // namespace fencepost::devices
