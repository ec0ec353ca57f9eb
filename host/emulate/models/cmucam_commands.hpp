// Which commands each CMUcam knows, with how many arguments.
#pragma once

#include <cstddef>
#include <string_view>

#include "host/emulate/models/cmucam.hpp"

namespace fencepost::emulate {

enum class CmuCamJudgement : std::uint8_t {
  kAct,
  kAccept,   ///< with an ACK, though it changes nothing here
  kRefuse,   ///< it is known, but not with this number of arguments
  kUnknown,  ///< NCK
};

CmuCamJudgement cmucam_judgement(CmuCamModel model, std::string_view name, std::size_t arguments);

}  // namespace fencepost::emulate
