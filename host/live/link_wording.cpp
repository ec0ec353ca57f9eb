#include "host/live/link_wording.hpp"

namespace fencepost::host {
namespace {

using sensor::LinkState;

std::string remedy_of(const DeviceLabel& label, LinkState state, const std::string& problem) {
  switch (state) {
    case LinkState::kAbsent: return problem;
    case LinkState::kSilent: return "nothing answers; " + label.silent;
    case LinkState::kUnready: return label.unready;
    case LinkState::kEmpty:
    case LinkState::kOk: break;
  }
  return {};
}

}  // namespace

LinkWording word_link(const DeviceLabel& label, LinkState state, const std::string& problem) {
  return {label.name, label.device, label.detail, remedy_of(label, state, problem)};
}

}  // namespace fencepost::host
