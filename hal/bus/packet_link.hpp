// Whole telegrams instead of single bytes: a USB pipe, or a serial line with length prefixes.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/base/result.hpp"

namespace fencepost::bus {

/// No call waits. `send` takes a whole telegram or nothing (kFull) and answers its size.
/// `receive` fills the front of the buffer with one telegram and answers its size. kNotReady: none there. kBadInput:
/// one came that was longer than the buffer or malformed, and is dropped. kGone, of both: unplugged; later calls may
/// succeed again.
template <class T>
concept PacketLink = requires(T link, std::span<const std::uint8_t> out, std::span<std::uint8_t> in) {
  { link.send(out) } -> std::same_as<base::Result<std::size_t>>;
  { link.receive(in) } -> std::same_as<base::Result<std::size_t>>;
};

}  // namespace fencepost::bus
