// Pixy, the CMUcam5.
#include "drivers/pixy1/pixy1.hpp"

#include "drivers/pixy1/usb.hpp"
#include "host/devices/options.hpp"
#include "host/devices/ported.hpp"
#include "host/emulate/models/pixy1.hpp"

namespace fencepost::devices {

Rows pixy1();

namespace {

using enum PlaceKind;

constexpr std::uint32_t kPixy1Baud = 19'200;

std::unique_ptr<host::CameraDevice> open_pixy1(const Opening& opening) {
  if (opening.spec.place.kind == kI2c) return camera_on_i2c<pixy1::Camera<I2cLink>>(opening);
  if (opening.spec.place.kind == kUsb) {
    return std::make_unique<host::PortedCamera<Ported<pixy1::UsbCamera<host::BytePort>>>>(
        kTalks, host::open_pixy_pipe(opening.spec.option("serial"), opening.port()));
  }
  return std::make_unique<host::PortedCamera<Ported<pixy1::Camera<host::BytePort>>>>(kTalks, open_line(opening));
}

std::optional<sensor::CameraIntrinsics> pixy1_profile(const DeviceSpec& /*spec*/) { return pixy1::kProfile; }

}  // namespace

Rows pixy1() {
  return {{.name = "pixy1",
           .about = "Pixy, the CMUcam5",
           .role = Role::kCamera,
           .live = Live{.places = {kTty, kTcp, kI2c, kUsb},
                        .options = {baud(kPixy1Baud), address(pixy1::kAddress), serial()},
                        .unready = "what comes is no Pixy's: in PixyMon choose the data out port (UART, I2C) and the "
                                   "baud rate",
                        .driver = CameraDriver{open_pixy1, pixy1_profile,
                                               "published: 75 by 47 degrees, said of the lens it is delivered with"}},
           .emulated = Emulated{.tells = "",
                                .options = {line_baud(kPixy1Baud)},
                                .describe = emulate::describe_pixy1,
                                .make = [](const DeviceSpec& spec,
                                           const emulate::Colours&) -> std::unique_ptr<emulate::DeviceModel> {
                                  return std::make_unique<emulate::Pixy1>(spec.number("baud"));
                                },
                                .image = image_of(pixy1::kProfile, {.first_signature = 1, .last_signature = 7}, 50),
                                .asked = true},
           .images = {"pixy1", "pixy1_i2c"},
           .tried = {{.others = "Arduino library (UART)"},
                     {kI2c, "Pixy1Camera.SeesOverI2cWhatItSeesOverSerial", "RunOnCamera.Pixy1OnI2c"},
                     {kUsb, "pixy1:usb", "RunOnCamera.Pixy1OnUsb"}}}};
}

}  // namespace fencepost::devices
