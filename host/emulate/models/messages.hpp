// Describes messages on a line for people: hex, and what they mean.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace fencepost::emulate {

/// Describes the first message in `bytes` in words, such as "getBlocks" or "2 blocks"; empty if it is unknown. `bytes`
/// has at least one byte.
using Describe = std::string (*)(bool from_host, std::span<const std::uint8_t> bytes);

/// Of protocols in plain text: the text itself, quoted.
std::string describe_text(bool from_host, std::span<const std::uint8_t> bytes);
std::string describe_pixy2(bool from_host, std::span<const std::uint8_t> bytes);
std::string describe_create(bool from_host, std::span<const std::uint8_t> bytes);
std::string describe_nxt(bool from_host, std::span<const std::uint8_t> bytes);
/// Commands in text, binary packets.
std::string describe_avrcam(bool from_host, std::span<const std::uint8_t> bytes);
std::string describe_nxtcam5(bool from_host, std::span<const std::uint8_t> bytes);
std::string describe_can(bool from_host, std::span<const std::uint8_t> bytes);

/// "AE C1 0E 00", cut after `most` bytes.
std::string hex_of(std::span<const std::uint8_t> bytes, std::size_t most = 48);

}  // namespace fencepost::emulate
