// Numbers in the files that boot loaders take.
#pragma once

#include <cstdint>
#include <string>

namespace fencepost::host {

/// Appends the low `bytes` of `value`, the lowest first.
inline void put_little_endian(std::string& out, std::uint32_t value, unsigned bytes = sizeof(std::uint32_t)) {
  for (unsigned i = 0; i < bytes; ++i) out.push_back(static_cast<char>(value >> (8 * i) & 0xFFU));
}

}  // namespace fencepost::host
