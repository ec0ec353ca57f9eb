// HuskyLens 1 and 2.
#include "drivers/huskylens/huskylens.hpp"

#include "host/devices/options.hpp"
#include "host/devices/ported.hpp"
#include "host/emulate/models/huskylens.hpp"
#include "host/emulate/models/huskylens2.hpp"

namespace fencepost::devices {

Rows huskylens();

namespace {

using enum PlaceKind;

constexpr const char* kNoAngle = "assumed: no source tells an angle";
constexpr std::uint32_t kHuskylensBaud = 9'600;
constexpr std::uint32_t kHuskylens2Baud = 115'200;
constexpr const char* kUnready = "it has learned no colour, is busy, or shows a menu";

template <huskylens::Generation Generation>
std::unique_ptr<host::CameraDevice> open_huskylens(const Opening& opening) {
  const huskylens::Options options{.generation = Generation};
  if (opening.spec.place.kind == kI2c) return camera_on_i2c<huskylens::Camera<I2cLink>>(opening, options);
  return camera_on_line<huskylens::Camera<host::BytePort>>(opening, options);
}

template <const sensor::CameraIntrinsics& Profile>
std::optional<sensor::CameraIntrinsics> huskylens_profile(const DeviceSpec& /*spec*/) {
  return Profile;
}

Row huskylens2() {
  return {.name = "huskylens2",
          .about = "HuskyLens 2; its lens is a guess: calibrate",
          .role = Role::kCamera,
          .live = Live{.places = {kTty, kTcp, kI2c},
                       .options = {baud(kHuskylens2Baud), address(huskylens::kAddress2)},
                       .unready = kUnready,
                       .driver = CameraDriver{open_huskylens<huskylens::Generation::kTwo>,
                                              huskylens_profile<huskylens::kProfile2>, kNoAngle}},
          .emulated =
              Emulated{.tells = "blocks of learned colours; no arrows",
                       .options = {line_baud(kHuskylens2Baud)},
                       .describe = emulate::describe_huskylens2,
                       .make = [](const DeviceSpec&, const emulate::Colours&) -> std::unique_ptr<emulate::DeviceModel> {
                         return std::make_unique<emulate::HuskyLens2>();
                       },
                       .image = image_of(huskylens::kProfile2, {.first_signature = 1, .last_signature = 127}, 30),
                       .asked = true},
          .images = {"huskylens2", "huskylens2_i2c"},
          .tried = {{.others = "DFRobot_HuskylensV2, PyHuskyLens"}}};
}

}  // namespace

Rows huskylens() {
  return {
      {.name = "huskylens",
       .about = "HuskyLens 1; its lens is a guess: calibrate",
       .role = Role::kCamera,
       .live = Live{.places = {kTty, kTcp, kI2c},
                    .options = {baud(kHuskylensBaud), address(huskylens::kAddress)},
                    .unready = kUnready,
                    .driver = CameraDriver{open_huskylens<huskylens::Generation::kOne>,
                                           huskylens_profile<huskylens::kProfile>, kNoAngle}},
       .emulated =
           Emulated{.tells = "blocks of learned colours; no arrows",
                    .options = {line_baud(kHuskylensBaud)},
                    .describe = emulate::describe_huskylens,
                    .make = [](const DeviceSpec&, const emulate::Colours&) -> std::unique_ptr<emulate::DeviceModel> {
                      return std::make_unique<emulate::HuskyLens>(base::Time{}, emulate::HuskyLens::kColours);
                    },
                    .image = image_of(huskylens::kProfile, {.first_signature = 1}, 30),
                    .asked = true},
       .images = {"huskylens", "huskylens_i2c"},
       .tried = {{.others = "HUSKYLENSArduino, HUSKYLENSPython, PyHuskyLens"},
                 {kI2c, "HuskyLens.SeesOverI2cWhatItSeesOverSerial"}}},
      huskylens2()};
}

}  // namespace fencepost::devices
