// How a device is named on a command line: KIND:PLACE[,option=value...].
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "hal/base/result.hpp"

namespace fencepost::host {

enum class DeviceRole : std::uint8_t { kCamera, kOdometry };

enum class DeviceKind : std::uint8_t {
  kPixy2,
  kPixy21,
  kCmuCam1,
  kCmuCam2,
  kCmuCam3,
  kCmuCam4,
  kNxtCam,
  kNxtCam5,
  kAvrCam,
  kXbc,
  kCreate1,
  kCreate2,
  kNxt,
  kCan,
  kRecords,
  kConsole,
};

/// Where a device is plugged in.
enum class PlaceKind : std::uint8_t {
  kTty,   ///< the path of a serial port, with a slash in it
  kTcp,   ///< tcp:HOST:PORT
  kI2c,   ///< /dev/i2c-N
  kSpi,   ///< /dev/spidevN.M
  kUsb,   ///< usb
  kNxt,   ///< nxt: behind the NXT brick that is the odometry
  kCan,   ///< a CAN interface, such as can0
  kNone,  ///< of a device that is no device: the console
};

struct Place {
  PlaceKind kind = PlaceKind::kNone;
  std::string name;        ///< as written; of tcp the host
  std::uint16_t port = 0;  ///< of tcp
};

struct DeviceSpec {
  DeviceKind kind = DeviceKind::kConsole;
  std::string text;  ///< as written
  Place place;
  std::map<std::string, std::string> options;  ///< checked: known to this kind at this place, and in range

  /// The kind's name, such as "pixy2".
  [[nodiscard]] std::string_view kind_name() const;
  /// "pixy2 at /dev/ttyUSB0"; of the console "console".
  [[nodiscard]] std::string where() const;
  [[nodiscard]] std::string option(const std::string& name, const std::string& fallback) const;
  [[nodiscard]] std::uint32_t number(const std::string& name, std::uint32_t fallback) const;
};

/// errors: a sentence that says what is wrong in `text` and what is allowed instead.
base::Result<DeviceSpec, std::string> parse_device(std::string_view text, DeviceRole role);

/// `tcp:HOST:PORT` ([HOST] for an address of IPv6), or nothing.
std::optional<Place> parse_tcp(std::string_view text);

/// What --help says of the devices of a role: kind, places, options, a line each.
std::string describe_devices(DeviceRole role);

}  // namespace fencepost::host
