// Grove Vision AI V2.
#include "drivers/grove/grove.hpp"

#include "host/devices/options.hpp"
#include "host/devices/ported.hpp"
#include "host/emulate/models/grove.hpp"

namespace fencepost::devices {

Rows grove();

namespace {

using enum PlaceKind;

constexpr std::uint32_t kGroveBaud = 921'600;

struct GroveOnBus {
  GroveOnBus(std::unique_ptr<host::I2cPort> port, std::uint8_t address) : bus(std::move(port)), driver(*bus, address) {}
  [[nodiscard]] host::Port& port() const { return *bus; }

  std::unique_ptr<host::I2cPort> bus;
  grove::I2cCamera<host::I2cPort> driver;
};

std::unique_ptr<host::CameraDevice> open_grove(const Opening& opening) {
  if (opening.spec.place.kind != kI2c) return camera_on_line<grove::Camera<host::BytePort>>(opening);
  return std::make_unique<host::PortedCamera<GroveOnBus>>(kLookedAt,
                                                          host::open_i2c(opening.spec.place.name, opening.port()),
                                                          static_cast<std::uint8_t>(opening.spec.number("address")));
}

}  // namespace

Rows grove() {
  return {{.name = "grove",
           .about = "Grove Vision AI V2, SSCMA firmware with a model of boxes; calibrate",
           .role = Role::kCamera,
           .live = Live{.places = {kTty, kTcp, kI2c},
                        .options = {baud(kGroveBaud), address(grove::kAddress)},
                        .unready = "no model is in it, or one that finds no boxes",
                        .driver = CameraDriver{open_grove,
                                               [](const DeviceSpec&) -> std::optional<sensor::CameraIntrinsics> {
                                                 return grove::kProfile;
                                               },
                                               "assumed: an OV5647 of 62 degrees, all columns of its picture"}},
           .emulated = Emulated{.tells = "boxes of a model's classes, in whole pixels",
                                .options = {line_baud(kGroveBaud)},
                                .describe = emulate::describe_text,
                                .make = [](const DeviceSpec&,
                                           const emulate::Colours&) -> std::unique_ptr<emulate::DeviceModel> {
                                  return std::make_unique<emulate::Grove>();
                                },
                                .image = image_of(grove::kProfile, {.first_signature = 1}, 15)},
           .images = {"grove", "grove_i2c"},
           .tried = {{}, {kI2c, "GroveCamera.SeesOverI2cWhatItSeesOverSerial"}}}};
}

}  // namespace fencepost::devices
