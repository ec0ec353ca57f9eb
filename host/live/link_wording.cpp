#include "host/live/link_wording.hpp"

namespace fencepost::host {
namespace {

using sensor::LinkState;

std::string_view silent_remedy(PlaceKind place) {
  switch (place) {
    case PlaceKind::kTty: return "check its power, the wires (TX to RX) and the baud";
    case PlaceKind::kI2c: return "check its power, the wires and the address; 'i2cdetect -y N' lists who answers";
    case PlaceKind::kSpi: return "check its power and the wires, and that the camera is set to SPI";
    case PlaceKind::kCan: return "check power, termination and bit rate; 'candump' shows what comes";
    case PlaceKind::kNxt: return "check the cable between camera and brick, and port=";
    default: return "check that it is switched on";
  }
}

std::string_view unready_remedy(DeviceKind kind) {
  switch (kind) {
    case DeviceKind::kPixy2:
    case DeviceKind::kPixy21: return "it starts, runs another program, or its button is held";
    case DeviceKind::kCmuCam1:
    case DeviceKind::kCmuCam2:
    case DeviceKind::kCmuCam3:
    case DeviceKind::kCmuCam4: return "it is being set up, or of another kind";
    case DeviceKind::kNxtCam:
    case DeviceKind::kNxtCam5:
    case DeviceKind::kAvrCam: return "teach it colours with the maker's program";
    case DeviceKind::kXbc: return "start fencepost_xbc.ic on it, of this version";
    case DeviceKind::kCreate1:
    case DeviceKind::kCreate2: return "what comes is no sensor stream: check the baud and the model";
    case DeviceKind::kNxt: return "its motors do not answer: check left= and right=";
    case DeviceKind::kCan: return "one wheel is missing, or its frames are too short: check \"can\" in the robot file";
    case DeviceKind::kRecords: return "what comes is no $FPODO: check the baud and what the other end sends";
    case DeviceKind::kConsole: break;
  }
  return "it is not ready yet";
}

std::string remedy_of(const DeviceSpec& spec, LinkState state, const std::string& problem) {
  switch (state) {
    case LinkState::kAbsent: return problem;
    case LinkState::kSilent: return "nothing answers; " + std::string(silent_remedy(spec.place.kind));
    case LinkState::kUnready: return std::string(unready_remedy(spec.kind));
    case LinkState::kEmpty:
    case LinkState::kOk: break;
  }
  return {};
}

}  // namespace

LinkWording word_link(DeviceRole role, const DeviceSpec& spec, LinkState state, const std::string& problem) {
  const std::string_view sensor = role == DeviceRole::kCamera ? "camera " : "odometry ";
  return {std::string(sensor) + spec.where(), std::string(spec.kind_name()), spec.place.name,
          remedy_of(spec, state, problem)};
}

}  // namespace fencepost::host
