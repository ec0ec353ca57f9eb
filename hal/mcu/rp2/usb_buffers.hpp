// The USB controller's memory: packets that the interrupt and the controller hand to each other (RP2040
// datasheet 4.1.2.5).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/mcu/register.hpp"
#include "hal/mcu/rp2/part.hpp"
#include "hal/mcu/rp2/usb_descriptors.hpp"

namespace fencepost::mcu::rp2::usb {

/// As the host sees it.
enum Direction : std::uint32_t { kIn = 0, kOut = 1 };

inline std::uint32_t buffer_bit(std::uint32_t endpoint, Direction direction) {
  return 1U << (2 * endpoint + direction);
}
inline std::uint32_t buffer_control(std::uint32_t endpoint, Direction direction) {
  return kUsbBufferControl + 8 * endpoint + 4 * direction;
}

inline constexpr std::uint32_t kControlBuffer = 0x100;  // of endpoint 0, both ways: fixed (table 4.1.2.5.1)
inline constexpr std::uint32_t kInBuffer = 0x180;       // ours begin behind it
inline constexpr std::uint32_t kOutBuffer = 0x1C0;
inline constexpr std::uint32_t kNotifyBuffer = 0x200;

inline std::uint32_t buffer_of(std::uint32_t endpoint, Direction direction) {
  if (endpoint == 0) return kUsbMemory + kControlBuffer;
  return kUsbMemory + (direction == kIn ? kInBuffer : kOutBuffer);
}
inline volatile std::uint8_t& byte_of(std::uint32_t address) {
  return *reinterpret_cast<volatile std::uint8_t*>(static_cast<std::uintptr_t>(address));
}

inline void clear_memory() {
  for (std::uint32_t i = 0; i < kUsbMemorySize; i += 4) reg(kUsbMemory + i) = 0;
}

inline void set_up_endpoints() {
  const auto control = [](std::uint32_t endpoint, Direction direction) {
    return kUsbEndpointControl + 8 * (endpoint - 1) + 4 * direction;
  };
  reg(control(kNotifyEndpoint, kIn)) = kEndpointOn | kEndpointTellEach | kEndpointInterrupt | kNotifyBuffer;
  reg(control(kDataEndpoint, kIn)) = kEndpointOn | kEndpointTellEach | kEndpointBulk | kInBuffer;
  reg(control(kDataEndpoint, kOut)) = kEndpointOn | kEndpointTellEach | kEndpointBulk | kOutBuffer;
}

/// Hands a buffer to the controller: of `size` bytes to send, or with room for so many. The controller runs at 48 MHz,
/// so the bit that hands it over comes some cycles after the rest (4.1.2.5.1).
inline void arm(std::uint32_t endpoint, Direction direction, std::size_t size, bool data1) {
  const std::uint32_t word =
      static_cast<std::uint32_t>(size) | (direction == kIn ? kBufferFull : 0) | (data1 ? kBufferData1 : 0);
  const std::uint32_t control = buffer_control(endpoint, direction);
  reg(control) = word;
  asm volatile("nop\n\tnop\n\tnop\n\tnop\n\tnop\n\tnop\n\tnop\n\tnop\n\tnop\n\tnop\n\tnop\n\tnop");
  reg(control) = word | kBufferAvailable;
}
/// Takes a buffer back; false if the controller has used it already. Since an RP2040's B2 it is asked to let go of it
/// first; before, that register does not work (erratum RP2040-E2).
inline bool withdraw(std::uint32_t endpoint, Direction direction) {
  constexpr std::uint32_t kB2 = 2;
  constexpr std::uint32_t kMaxPolls = 2'000;  // 0.1 ms: longer than a packet and its acknowledgement
  const bool can_abort = reg(kChipId) >> kChipRevisionShift >= kB2;
  const std::uint32_t control = buffer_control(endpoint, direction);
  const std::uint32_t bit = buffer_bit(endpoint, direction);
  if (can_abort) {
    raise_bits(kUsbAbort, bit);
    static_cast<void>(await_bits(kUsbAborted, bit, kMaxPolls));
  }
  const bool unused = (reg(control) & kBufferAvailable) != 0;
  reg(control) = 0;
  if (can_abort) {
    lower_bits(kUsbAborted, bit);
    lower_bits(kUsbAbort, bit);
  }
  return unused;
}
inline void stall(std::uint32_t endpoint) {
  reg(buffer_control(endpoint, kIn)) = kBufferStall;
  reg(buffer_control(endpoint, kOut)) = kBufferStall;
}

inline void fill(std::uint32_t endpoint, Direction direction, std::span<const std::uint8_t> bytes) {
  std::uint32_t to = buffer_of(endpoint, direction);
  for (const std::uint8_t byte : bytes) byte_of(to++) = byte;
}
/// For each byte that came.
template <class Take>
void for_each_byte(std::uint32_t endpoint, Direction direction, Take&& take) {
  const std::uint32_t size = reg(buffer_control(endpoint, direction)) & kBufferLength;
  const std::uint32_t from = buffer_of(endpoint, direction);
  for (std::uint32_t i = 0; i < size; ++i) take(byte_of(from + i));
}
inline void copy_out(std::uint32_t endpoint, Direction direction, std::span<std::uint8_t> into) {
  std::uint32_t from = buffer_of(endpoint, direction);
  for (std::uint8_t& byte : into) byte = byte_of(from++);
}

}  // namespace fencepost::mcu::rp2::usb
