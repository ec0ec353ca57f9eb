// Integers from and to bytes, one by one: no alignment, no byte order of the machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/base/check.hpp"

namespace fencepost::wire {

/// The `count` (1 to 8) bytes from `at` on, least significant first.
constexpr std::uint64_t little(std::span<const std::uint8_t> bytes, std::size_t at, std::size_t count) {
  FENCEPOST_CHECK(at + count <= bytes.size());
  std::uint64_t value = 0;
  for (std::size_t i = count; i > 0; --i) value = value << 8U | bytes[at + i - 1];
  return value;
}

/// The same, most significant first.
constexpr std::uint64_t big(std::span<const std::uint8_t> bytes, std::size_t at, std::size_t count) {
  FENCEPOST_CHECK(at + count <= bytes.size());
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < count; ++i) value = value << 8U | bytes[at + i];
  return value;
}

constexpr std::uint16_t little_u16(std::span<const std::uint8_t> bytes, std::size_t at) {
  return static_cast<std::uint16_t>(little(bytes, at, 2));
}
constexpr std::uint32_t little_u32(std::span<const std::uint8_t> bytes, std::size_t at) {
  return static_cast<std::uint32_t>(little(bytes, at, 4));
}
constexpr std::int32_t little_i32(std::span<const std::uint8_t> bytes, std::size_t at) {
  return static_cast<std::int32_t>(little_u32(bytes, at));
}

/// The low or high byte of a 16-bit word.
constexpr std::uint8_t low(unsigned word) { return static_cast<std::uint8_t>(word & 0xFFU); }
constexpr std::uint8_t high(unsigned word) { return static_cast<std::uint8_t>(word >> 8U & 0xFFU); }

}  // namespace fencepost::wire
