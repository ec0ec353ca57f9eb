// Takes the bytes that have arrived on a byte link.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/base/result.hpp"
#include "hal/bus/byte_link.hpp"

namespace fencepost::wire {

/// Gives the bytes that the link has now to `take`, a chunk at a time. At most `reads` reads of 32 bytes, for some
/// links always have some. False: the link is gone.
template <bus::ByteLink Link, class Take>
bool receive(Link& link, int reads, Take&& take) {
  std::array<std::uint8_t, 32> bytes{};
  for (int i = 0; i < reads; ++i) {
    const base::Result<std::size_t> got = link.read(bytes);
    if (!got) return got.error() != base::Error::kGone;
    take(std::span<const std::uint8_t>(bytes).first(*got));
  }
  return true;
}

}  // namespace fencepost::wire
