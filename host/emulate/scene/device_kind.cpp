#include "host/emulate/scene/device_kind.hpp"

#include <cstdlib>

#include "drivers/odometry/wheel_base.hpp"
#include "host/text/device_word.hpp"

namespace fencepost::emulate {
namespace {

constexpr ImageLimits kPixy2Image{316, 208, 16, 16, 1, 7, 61};
constexpr ImageLimits kNxtCamImage{176, 144, 8, 8, 0, 7, 30};
constexpr ImageLimits kNxtCam5Image{240, 160, 16, 16, 0, 255, 30};
constexpr double kCmuCamRate = 17;

constexpr ImageLimits cmucam_image(std::uint16_t width, std::uint16_t height, double rate) {
  return {width, height, 16, 16, 0, 255, rate};
}

// Two blobs a channel is what fencepost_xbc.ic sends.
constexpr ImageLimits kXbcImage{356, 291, 6, 2, 1, 3, 15};

template <CmuCamModel Model>
std::unique_ptr<Peer> make_cmucam(const DeviceSpec&, const Colours& colours) {
  return make_cmucam_peer(Model, colours);
}
template <CreateModel Model>
std::unique_ptr<Peer> make_create(const DeviceSpec& spec, const Colours&) {
  return make_create_peer(Model, spec.wheels);
}
std::unique_ptr<Peer> make_pixy2(const DeviceSpec&, const Colours&) { return make_pixy2_peer(); }
std::unique_ptr<Peer> make_xbc(const DeviceSpec&, const Colours&) { return make_xbc_peer(); }
std::unique_ptr<Peer> make_nxtcam(const DeviceSpec&, const Colours&) { return make_nxtcam_peer(); }
std::unique_ptr<Peer> make_nxtcam5(const DeviceSpec&, const Colours&) { return make_nxtcam5_peer(); }
std::unique_ptr<Peer> make_nxt(const DeviceSpec& spec, const Colours&) {
  return make_nxt_peer(spec.wheels, spec.camera_port);
}
std::unique_ptr<Peer> make_can(const DeviceSpec& spec, const Colours&) {
  return make_can_peer(spec.talon ? CanWheels::Kind::kTalonSrx : CanWheels::Kind::kCanopen, spec.wheels);
}
std::unique_ptr<Peer> make_records(const DeviceSpec&, const Colours&) { return make_records_peer(); }

// Create: Open Interface specification. NXT: the wheel and the track of the set's first robot. CAN: any; a count of 0.1
// mm is easy to read.
constexpr double metres(std::int64_t picometres) { return static_cast<double>(picometres) * 1e-12; }
constexpr WheelShape kCreateShape{metres(odometry::kCreate2Wheels.left_pm_per_count),
                                  metres(odometry::kCreate2Wheels.track_pm)};
constexpr WheelShape kNxtShape{metres(odometry::per_count({56.0, 360.0})), 0.112};
constexpr WheelShape kCanShape{0.0001, 0.235};

bool to_number(const std::string& text, double& value) {
  if (text.empty() || text.find_first_not_of("0123456789.") != std::string::npos) return false;
  char* end = nullptr;
  value = std::strtod(text.c_str(), &end);
  return end == text.c_str() + text.size();
}

std::vector<std::string> names() {
  std::vector<std::string> list;
  for (const DeviceKind& kind : device_kinds()) list.emplace_back(kind.name);
  return list;
}

const DeviceKind* find(std::string_view name) {
  for (const DeviceKind& kind : device_kinds()) {
    if (kind.name == name) return &kind;
  }
  return nullptr;
}

/// A sentence if the option is not one of the device's, or its value none.
std::string set_option(DeviceSpec& spec, const host::DeviceOption& option) {
  const auto& [name, text] = option;
  const std::optional<std::uint32_t> whole = host::whole_number(text);
  double value = 0;
  const bool number = to_number(text, value);
  if (name == "baud" && whole && *whole <= 4'000'000 && (*whole >= 50 || *whole == 0)) {
    spec.baud = *whole;
  } else if (name == "tick" && spec.kind->wheels.tick > 0 && number && value > 0 && value < 1) {
    spec.wheels.tick = value;
  } else if (name == "track" && spec.kind->wheels.tick > 0 && number && value > 0 && value < 10) {
    spec.wheels.track = value;
  } else if (name == "port" && spec.camera_port && (text == "1" || text == "2" || text == "3" || text == "4")) {
    spec.camera_port = text[0] - '0';
  } else if (name == "layout" && spec.kind->name == "can" && (text == "canopen" || text == "talon")) {
    spec.talon = text == "talon";
  } else {
    return "option \"" + name + "=" + text + "\" of " + std::string(spec.kind->name) +
           " is not possible; there are baud=N, of wheels tick=M and track=M in metres, of can layout=canopen|talon, "
           "of nxtcam:nxt port=1..4";
  }
  return {};
}

std::string set_place(DeviceSpec& spec, const std::string& place) {
  constexpr std::string_view kTcp = "tcp:";
  if (spec.kind->speech == Speech::kCan) {
    spec.place = DeviceSpec::Place::kCan;
    spec.where = place;
    return place.empty() ? "can needs an interface, such as can:vcan0" : "";
  }
  if (place.rfind(kTcp, 0) == 0) {
    spec.place = DeviceSpec::Place::kTcp;
    spec.where = place.substr(kTcp.size());
    return spec.where.empty() ? "tcp: needs a port, such as tcp:7000 (0: any free one)" : "";
  }
  if (place == "usb" || place.rfind("/dev/i2c", 0) == 0 || place.rfind("/dev/spidev", 0) == 0) {
    return "no " + std::string(spec.kind->name) + " at " + place + " can be emulated; only on a pty, on tcp, or on CAN";
  }
  if (place != "pty") spec.where = place;
  return {};
}

}  // namespace

const std::vector<DeviceKind>& device_kinds() {
  static const std::vector<DeviceKind> kinds = {
      {"pixy2", Speech::kPixy2, 19'200, kPixy2Image, 273.66, {}, make_pixy2},
      {"pixy2.1", Speech::kPixy2, 19'200, kPixy2Image, 188.3, {}, make_pixy2},
      {"cmucam1", Speech::kText, 115'200, cmucam_image(80, 143, kCmuCamRate), 0, {}, make_cmucam<CmuCamModel::kOne>},
      {"cmucam2", Speech::kText, 115'200, cmucam_image(88, 143, kCmuCamRate), 0, {}, make_cmucam<CmuCamModel::kTwo>},
      {"cmucam3", Speech::kText, 115'200, cmucam_image(88, 144, kCmuCamRate), 0, {}, make_cmucam<CmuCamModel::kThree>},
      {"cmucam4", Speech::kText, 19'200, cmucam_image(160, 120, 30), 0, {}, make_cmucam<CmuCamModel::kFour>},
      {"nxtcam", Speech::kAvrcam, 115'200, kNxtCamImage, 0, {}, make_nxtcam},
      {"nxtcam5", Speech::kNxtCam5, 115'200, kNxtCam5Image, 0, {}, make_nxtcam5},
      {"avrcam", Speech::kAvrcam, 115'200, kNxtCamImage, 0, {}, make_nxtcam},
      {"xbc", Speech::kText, 38'400, kXbcImage, 0, {}, make_xbc},
      {"create1", Speech::kCreate, 57'600, std::nullopt, 0, kCreateShape, make_create<CreateModel::kOne>},
      {"create2", Speech::kCreate, 115'200, std::nullopt, 0, kCreateShape, make_create<CreateModel::kTwo>},
      {"nxt", Speech::kNxt, 0, kNxtCamImage, 0, kNxtShape, make_nxt},
      {"can", Speech::kCan, 0, std::nullopt, 0, kCanShape, make_can},
      {"records", Speech::kText, 115'200, std::nullopt, 0, {}, make_records},
  };
  return kinds;
}

ParsedDevice parse_device(const std::string& text) {
  ParsedDevice parsed;
  const host::DeviceWord word = host::split_device(text);
  std::string name = word.kind;
  std::string place = word.place.value_or("");
  const bool short_form = name == "nxtcam@nxt";
  const bool behind_brick = short_form || (name == "nxtcam" && (place == "nxt" || place.starts_with("nxt:")));
  if (behind_brick) {
    name = "nxt";
    if (!short_form) place = place.size() > 4 ? place.substr(4) : "";
  }
  DeviceSpec& spec = parsed.spec;
  spec.kind = find(name);
  if (spec.kind == nullptr) {
    parsed.problem = host::no_such("device", name, names());
    return parsed;
  }
  spec.baud = spec.kind->baud;
  spec.wheels = spec.kind->wheels;
  if (behind_brick) spec.camera_port = 1;
  parsed.problem = set_place(spec, place);
  if (parsed.problem.empty()) parsed.problem = word.problem;
  for (const host::DeviceOption& option : word.options) {
    if (parsed.problem.empty()) parsed.problem = set_option(spec, option);
  }
  return parsed;
}

}  // namespace fencepost::emulate
