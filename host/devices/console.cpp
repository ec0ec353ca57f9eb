// Sensors whose records come as lines of the console.
#include "host/devices/row.hpp"

namespace fencepost::devices {

Rows console();

namespace {

Row row(Role role, const char* about, const std::variant<CameraDriver, OdometryDriver>& driver) {
  return {.name = "console",
          .about = about,
          .role = role,
          .live = Live{.places = {PlaceKind::kNone}, .options = {}, .unready = "it is not ready yet", .driver = driver},
          .emulated = std::nullopt,
          .images = {"console"}};
}

}  // namespace

Rows console() {
  return {row(Role::kCamera, "`$FPFRM` lines typed or sent to the console",
              CameraDriver{[](const Opening&) -> std::unique_ptr<host::CameraDevice> {
                             return std::make_unique<host::ConsoleCamera>();
                           },
                           [](const DeviceSpec&) { return std::optional<sensor::CameraIntrinsics>(); },
                           "given: by `$FPCAM`"}),
          row(Role::kOdometry, "`$FPODO` lines on the console",
              OdometryDriver{[](const Opening&) -> std::unique_ptr<host::OdometryDevice> {
                return std::make_unique<host::ConsoleOdometry>();
              }})};
}

}  // namespace fencepost::devices
