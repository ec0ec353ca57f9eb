// FNV-1a, 64 bit, over an explicit little-endian serialisation: the state digest of the record stream.
#pragma once

#include <cstdint>
#include <cstring>
#include <type_traits>

namespace fencepost::base {

class Fnv1a64 {
 public:
  static constexpr std::uint64_t kOffsetBasis = 0xcbf29ce484222325ULL;
  static constexpr std::uint64_t kPrime = 0x100000001b3ULL;

  /// Continues a chain: pass the previous value to hash "previous, then these bytes".
  constexpr explicit Fnv1a64(std::uint64_t state = kOffsetBasis) : state_(state) {}

  constexpr void u8(std::uint8_t v) { state_ = times_prime(state_ ^ v); }
  constexpr void u16(std::uint16_t v) {
    u8(static_cast<std::uint8_t>(v & 0xFFU));
    u8(static_cast<std::uint8_t>(static_cast<unsigned>(v) >> 8U));
  }
  constexpr void u32(std::uint32_t v) {
    for (unsigned shift = 0; shift < 32; shift += 8) u8(static_cast<std::uint8_t>((v >> shift) & 0xFFU));
  }
  constexpr void i32(std::int32_t v) { u32(static_cast<std::uint32_t>(v)); }
  constexpr void i64(std::int64_t v) {
    u32(static_cast<std::uint32_t>(static_cast<std::uint64_t>(v) & 0xFFFFFFFFU));
    u32(static_cast<std::uint32_t>(static_cast<std::uint64_t>(v) >> 32U));
  }
  /// The IEEE-754 bits. memcpy, since one of our targets' libraries lacks std::bit_cast.
  void f32(float v) {
    std::uint32_t bits = 0;
    static_assert(sizeof bits == sizeof v);
    std::memcpy(&bits, &v, sizeof bits);
    u32(bits);
  }
  [[nodiscard]] constexpr std::uint64_t value() const { return state_; }

 private:
#if defined(__ARM_ARCH_ISA_THUMB) && __ARM_ARCH_ISA_THUMB == 1
  static constexpr bool kLongMultiplication = false;
#else
  static constexpr bool kLongMultiplication = true;
#endif

  // The prime is 2^40 + 0x1B3. A core without long multiplication does the second part in half words. That is four
  // times as fast as its 64-bit multiplication, and the hash is a tenth of a frame's work.
  static constexpr std::uint64_t times_prime(std::uint64_t v) {
    if constexpr (kLongMultiplication) return v * kPrime;
    std::uint32_t factor = 0x1B3;
    // A constant would become seven shifts and additions; these cores multiply in one cycle.
    if (!std::is_constant_evaluated()) asm("" : "+r"(factor));
    const auto low = static_cast<std::uint32_t>(v);
    const auto high = static_cast<std::uint32_t>(v >> 32U);
    const std::uint32_t carried = ((((low & 0xFFFFU) * factor) >> 16U) + (low >> 16U) * factor) >> 16U;
    return (std::uint64_t{high * factor + carried + (low << 8U)} << 32U) | (low * factor);
  }

  std::uint64_t state_;
};

}  // namespace fencepost::base
