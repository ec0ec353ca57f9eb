// Bytes on a line for people: hex, and what they mean.
#pragma once

#include <span>
#include <string>

#include "host/emulate/scene/device_kind.hpp"

namespace fencepost::emulate {

/// "AE C1 0E 00", cut after `most` bytes.
std::string hex_of(std::span<const std::uint8_t> bytes, std::size_t most = 48);

/// The first message in `bytes` in words, such as "getBlocks" or "2 blocks"; empty if it is none that is known.
std::string words_of(Speech speech, bool from_host, std::span<const std::uint8_t> bytes);

}  // namespace fencepost::emulate
