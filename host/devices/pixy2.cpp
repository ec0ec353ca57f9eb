// Pixy2 and Pixy2.1.
#include "drivers/pixy2/camera.hpp"
#include "drivers/pixy2/chirp_link.hpp"
#include "hal/linux/usb_settings.hpp"
#include "host/devices/options.hpp"
#include "host/devices/ported.hpp"
#include "host/emulate/models/camera_adapters.hpp"

namespace fencepost::devices {

Rows pixy2();

namespace {

using enum PlaceKind;
using Camera = std::unique_ptr<host::CameraDevice>;

constexpr std::uint32_t kPixy2Baud = 19'200;
constexpr std::uint8_t kPixy2Address = 0x54;  // Pixy2 documentation, porting guide

struct Pixy2OnUsb {
  explicit Pixy2OnUsb(std::unique_ptr<host::BytePort> port) : pipe(std::move(port)) {}
  [[nodiscard]] host::Port& port() const { return *pipe; }

  std::unique_ptr<host::BytePort> pipe;
  pixy2::ChirpLink<host::BytePort> chirp{*pipe};
  pixy2::Camera<pixy2::ChirpLink<host::BytePort>> driver{chirp};
};

using Pixy2OnLine = Ported<pixy2::Camera<host::BytePort>>;

Camera open_pixy2(const Opening& opening) {
  const DeviceSpec& spec = opening.spec;
  switch (spec.place.kind) {
    case kI2c: return camera_on_i2c<pixy2::Camera<I2cLink>>(opening);
    case kSpi:
      return std::make_unique<host::PortedCamera<Pixy2OnLine>>(
          kLookedAt, host::open_spi(spec.place.name, spec.number("hertz"), opening.port()));
    case kUsb:
      return std::make_unique<host::PortedCamera<Pixy2OnUsb>>(
          kAsked, host::open_pixy_pipe(spec.option("serial"), opening.port()));
    case kTty:
    case kTcp:
    case kNxt:
    case kCan:
    case kVideo:
    case kFilm:
    case kNone: break;
  }
  return std::make_unique<host::PortedCamera<Pixy2OnLine>>(kAsked, open_line(opening));
}

template <const sensor::CameraIntrinsics& Profile>
std::optional<sensor::CameraIntrinsics> pixy2_profile(const DeviceSpec& /*spec*/) {
  return Profile;
}

template <const sensor::CameraIntrinsics& Profile>
Row row(const char* name, const char* about, const char* lens) {
  return {.name = name,
          .about = about,
          .role = Role::kCamera,
          .live = Live{.places = {kTty, kTcp, kI2c, kSpi, kUsb},
                       .options = {baud(kPixy2Baud),
                                   address(kPixy2Address),
                                   {"hertz", Whole{10'000, 2'000'000}, "2000000", "of the clock", {kSpi}},
                                   serial()},
                       .unready = "it starts, runs another program, or its button is held",
                       .driver = CameraDriver{open_pixy2, pixy2_profile<Profile>, lens}},
          .emulated =
              Emulated{.tells = "",
                       .options = {line_baud(kPixy2Baud)},
                       .describe = emulate::describe_pixy2,
                       .make = [](const DeviceSpec&, const emulate::Colours&) { return emulate::make_pixy2_model(); },
                       .image = image_of(Profile, {.first_signature = 1, .last_signature = 7}, 61),
                       .asked = true},
          .tried = {{kTty, "", "", "Arduino library (UART); firmware 3.0.20 compiled for a PC"},
                    {kI2c, "", "RunOnCamera.Pixy2OnI2cThatIsUnpluggedAndComesBack"},
                    {kUsb, "pixy2:usb", "RunOnCamera.Pixy2OnUsb"}}};
}

}  // namespace

Rows pixy2() {
  Rows rows = {row<pixy2::kPixy2Profile>("pixy2", "Pixy2", "maker: 60 by 40 degrees"),
               row<pixy2::kPixy21Profile>("pixy2.1", "Pixy2.1",
                                          "maker: 80 degrees, with some distortion of which it tells no figure; an M12 "
                                          "lens, which may be another one")};
  rows.front().images = {"pixy2", "pixy2_i2c"};
  rows.back().images = {"pixy2.1", "pixy2.1_i2c"};
  for (Row& row : rows) row.usb = UsbIds{linux::kPixyUsb.vendor, linux::kPixyUsb.product};
  return rows;
}

}  // namespace fencepost::devices
