// Where a device is plugged in.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace fencepost::host {

enum class PlaceKind : std::uint8_t {
  kTty,    ///< the path of a serial port, with a slash in it; of an emulated device the link to its pty, or empty
  kTcp,    ///< tcp:HOST:PORT
  kI2c,    ///< /dev/i2c-N
  kSpi,    ///< /dev/spidevN.M
  kUsb,    ///< usb
  kNxt,    ///< nxt: behind the NXT brick that is the odometry
  kCan,    ///< a CAN interface, such as can0
  kVideo,  ///< /dev/videoN
  kFilm,   ///< a file that ends in .y4m, .mjpeg, .jpg or .jpeg
  kNone,   ///< of a device that is no device: the console
};

struct Place {
  PlaceKind kind = PlaceKind::kNone;
  std::string name;        ///< as written; of tcp the host
  std::uint16_t port = 0;  ///< of tcp
};

/// `tcp:HOST:PORT` ([HOST] for an address of IPv6), or nothing.
/// `least`: 0 where the system may choose the port.
std::optional<Place> parse_tcp(std::string_view text, std::uint32_t least = 1);

/// A serial port as Windows names it: "COM3", or "\\\\.\\COM12".
bool is_com_port(std::string_view text);

/// The place that a text without known name means: "usb", "/dev/i2c-1", any path, and with `can` any other word too.
Place place_in(std::string_view text, bool can);

/// How places of a kind are written: "/dev/tty..."; of kNone nothing.
std::string_view place_pattern(PlaceKind kind);

/// Things to check where nothing answers at such a place.
std::string_view silent_remedy(PlaceKind kind);

}  // namespace fencepost::host
