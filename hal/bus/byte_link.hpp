// The first seam: bytes.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/base/result.hpp"

namespace fencepost::bus {

/// A serial line, pty, socket or USB pipe. Neither call waits.
/// `read` fills the front of the buffer and answers how much (kNotReady: nothing there).
/// `write` takes what fits and answers how much (kFull: nothing fits now).
/// kGone: the link is unplugged; later calls may succeed again.
template <class T>
concept ByteLink = requires(T link, std::span<std::uint8_t> in, std::span<const std::uint8_t> out) {
  { link.read(in) } -> std::same_as<base::Result<std::size_t>>;
  { link.write(out) } -> std::same_as<base::Result<std::size_t>>;
};

}  // namespace fencepost::bus
