// The KIPR XBC.
#include "drivers/xbc/xbc.hpp"
#include "host/devices/options.hpp"
#include "host/devices/ported.hpp"
#include "host/emulate/models/camera_adapters.hpp"

namespace fencepost::devices {

Rows xbc();

namespace {

constexpr std::uint32_t kXbcBaud = 38'400;

}  // namespace

Rows xbc() {
  return {{.name = "xbc",
           .about = "XBC, with fencepost_xbc.ic running on it",
           .role = Role::kCamera,
           .live = Live{.places = {PlaceKind::kTty, PlaceKind::kTcp},
                        .options = {baud(kXbcBaud)},
                        .unready = "start fencepost_xbc.ic on it, of this version",
                        .driver = CameraDriver{[](const Opening& opening) {
                                                 return camera_on_line<xbc::Xbc<host::BytePort>>(opening,
                                                                                                 xbc::Config{});
                                               },
                                               [](const DeviceSpec&) -> std::optional<sensor::CameraIntrinsics> {
                                                 return xbc::nominal_intrinsics({});
                                               },
                                               "assumed: no source tells an angle"}},
           // Two blobs a channel is what fencepost_xbc.ic sends.
           .emulated =
               Emulated{.tells = "",
                        .options = {line_baud(kXbcBaud)},
                        .describe = emulate::describe_text,
                        .make = [](const DeviceSpec&, const emulate::Colours&) { return emulate::make_xbc_model(); },
                        .image = image_of(xbc::nominal_intrinsics({}), {6, 2, 1, 3}, 15)},
           .images = {"xbc"}}};
}

}  // namespace fencepost::devices
