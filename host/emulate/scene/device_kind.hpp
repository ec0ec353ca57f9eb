// Which devices can be emulated, and how one is named on a command line.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/emulate/scene/camera_peers.hpp"
#include "host/emulate/scene/image_fit.hpp"
#include "host/emulate/scene/wheel_peers.hpp"

namespace fencepost::emulate {

enum class Speech : std::uint8_t { kText, kPixy2, kCreate, kNxt, kAvrcam, kNxtCam5, kCan };

struct DeviceSpec;

struct DeviceKind {
  std::string_view name;
  Speech speech = Speech::kText;
  std::uint32_t baud = 0;            ///< as delivered; 0: no UART
  std::optional<ImageLimits> image;  ///< of cameras
  double focal = 0;                  ///< px, the vendor's or the usual one; 0: not told
  WheelShape wheels;                 ///< zeros: none that counts
  std::unique_ptr<Peer> (*make)(const DeviceSpec& spec, const Colours& colours) = nullptr;
};

const std::vector<DeviceKind>& device_kinds();

/// `KIND[:PLACE][,option=value...]`.
struct DeviceSpec {
  enum class Place : std::uint8_t { kPty, kTcp, kCan };

  const DeviceKind* kind = nullptr;
  Place place = Place::kPty;
  std::string where;  ///< pty: path of a link to it, or empty; tcp: [HOST:]PORT; can: interface
  std::uint32_t baud = 0;
  WheelShape wheels;
  bool talon = false;              ///< of can: Talon SRX frames instead of CANopen's
  std::optional<int> camera_port;  ///< of nxt: where an NXTCam is
};

struct ParsedDevice {
  DeviceSpec spec;
  std::string problem;  ///< a sentence; empty if all is well
};
/// PLACE: nothing or `pty`, a path (a link to the pty), `tcp:[HOST:]PORT`, of `can` the interface.
/// `nxtcam:nxt[,port=N]` and `nxtcam@nxt` are an NXT brick with the camera on it.
ParsedDevice parse_device(const std::string& text);

}  // namespace fencepost::emulate
