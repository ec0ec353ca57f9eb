// HuskyLens 1.
#include "drivers/huskylens/huskylens.hpp"

#include "host/devices/options.hpp"
#include "host/devices/ported.hpp"
#include "host/emulate/models/huskylens.hpp"

namespace fencepost::devices {

Rows huskylens();

namespace {

using enum PlaceKind;

constexpr std::uint32_t kHuskylensBaud = 9'600;

std::unique_ptr<host::CameraDevice> open_huskylens(const Opening& opening) {
  if (opening.spec.place.kind == kI2c) return camera_on_i2c<huskylens::Camera<I2cLink>>(opening);
  return camera_on_line<huskylens::Camera<host::BytePort>>(opening);
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
