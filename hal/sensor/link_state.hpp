// State of a device on a cable: four failures that need four different remedies, and "ok".
#pragma once

#include <string_view>

namespace fencepost::sensor {

enum class LinkState : unsigned char {
  kAbsent,   ///< no such device or port
  kSilent,   ///< the port is there, nothing answers: wiring, baud, power
  kUnready,  ///< it answers but cannot work yet: nothing trained, still starting
  kEmpty,    ///< it works and sees nothing
  kOk,       ///< it works and delivers
};

constexpr std::string_view name(LinkState state) {
  switch (state) {
    case LinkState::kAbsent: return "absent";
    case LinkState::kSilent: return "silent";
    case LinkState::kUnready: return "unready";
    case LinkState::kEmpty: return "empty";
    case LinkState::kOk: return "ok";
  }
  return "absent";
}

/// It delivers; that it sees nothing now is no fault.
constexpr bool works(LinkState state) { return state == LinkState::kOk || state == LinkState::kEmpty; }

}  // namespace fencepost::sensor
