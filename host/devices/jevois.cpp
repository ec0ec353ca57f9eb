// JeVois.
#include "drivers/jevois/jevois.hpp"

#include "host/devices/options.hpp"
#include "host/devices/ported.hpp"
#include "host/emulate/models/jevois.hpp"

namespace fencepost::devices {

Rows jevois();

namespace {

constexpr std::uint32_t kJevoisBaud = 115'200;

/// Maps the names of its module's things to the robot's colours; other things are distinguished by the number at their
/// end.
jevois::Config named(const host::RobotFile& robot) {
  jevois::Config config;
  for (const record::Signature& colour : robot.signatures) {
    if (!config.names.push_back({colour.name, colour.signature})) break;
  }
  return config;
}

}  // namespace

Rows jevois() {
  return {
      {.name = "jevois",
       .about = "JeVois, standardized serial messages; calibrate",
       .role = Role::kCamera,
       .live = Live{.places = {PlaceKind::kTty, PlaceKind::kTcp},
                    .options = {baud(kJevoisBaud)},
                    .unready = "no module of it streams: setmapping2 in its initscript.cfg",
                    .driver = CameraDriver{[](const Opening& opening) {
                                             return camera_on_line<jevois::JeVois<host::BytePort>>(
                                                 opening, named(opening.robot));
                                           },
                                           [](const DeviceSpec&) -> std::optional<sensor::CameraIntrinsics> {
                                             return jevois::nominal_intrinsics({});
                                           },
                                           "maker: 60 degrees, doc/Lenses.dox of its sources; 65 elsewhere; others: 90 "
                                           "degrees, a fisheye of 120"}},
       .emulated =
           Emulated{.tells = "boxes of things called blob1, blob2 ...",
                    .options = {line_baud(kJevoisBaud)},
                    .describe = emulate::describe_text,
                    .make = [](const DeviceSpec&, const emulate::Colours&) -> std::unique_ptr<emulate::DeviceModel> {
                      return std::make_unique<emulate::JeVois>();
                    },
                    .image = image_of(jevois::nominal_intrinsics({}), {.first_signature = 1}, 30)},
       .images = {"jevois"},
       .tried = {{.others = "messages of JeVois' own sources, compiled for a PC"}}}};
}

}  // namespace fencepost::devices
