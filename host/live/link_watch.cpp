#include "host/live/link_watch.hpp"

namespace fencepost::host {
namespace {

using sensor::LinkState;

constexpr base::Duration kLasting = base::milliseconds(1'000);

bool told_at_once(LinkState state) { return state == LinkState::kAbsent || state == LinkState::kOk; }

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
    case DeviceKind::kCmuCam4: return "it is being set up, or does not understand: check its kind";
    case DeviceKind::kNxtCam:
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

}  // namespace

LinkWatch::LinkWatch(DeviceRole role, const DeviceSpec& spec)
    : name_((role == DeviceRole::kCamera ? "camera " : "odometry ") + spec.where()), spec_(spec) {}

std::optional<LinkNews> LinkWatch::observe(LinkState state, const std::string& problem, base::Time now) {
  if (seen_ != state) {
    seen_ = state;
    since_ = now;
  }
  if (told_ == state || (!told_at_once(state) && now - since_ < kLasting)) return std::nullopt;
  told_ = state;
  LinkNews news;
  news.report = {now, sensor::Text(spec_.kind_name()), state, sensor::Text(spec_.place.name)};
  news.sentence = sentence(state, problem);
  return news;
}

std::string LinkWatch::sentence(LinkState state, const std::string& problem) const {
  switch (state) {
    case LinkState::kAbsent:
      return name_ + " is absent; going on without it until it is back" + (problem.empty() ? "" : ": " + problem);
    case LinkState::kSilent:
      return name_ + " is silent: nothing answers; " + std::string(silent_remedy(spec_.place.kind));
    case LinkState::kUnready: return name_ + " is unready; " + std::string(unready_remedy(spec_.kind));
    case LinkState::kEmpty: return name_ + " works and sees nothing";
    case LinkState::kOk: break;
  }
  return name_ + " works";
}

}  // namespace fencepost::host
