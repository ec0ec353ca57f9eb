// Division of integers by shifts and differences, for cores without an instruction for it where flash is short. It is a
// fifth of the compiler's own in size. A step is one bit of the quotient, so small quotients are quick.
#pragma once

#include <concepts>
#include <cstdint>
#include <type_traits>

namespace fencepost::mcu::division {

/// The two results that the run-time ABI for the Arm Architecture, 4.3.1, wants in consecutive registers.
template <std::integral Int>
struct Divided {
  Int quotient = 0;
  Int remainder = 0;
};

/// By zero: 0 and `n`, as the compiler's own.
template <std::unsigned_integral Word>
constexpr Divided<Word> divide_bits(Word n, Word d) {
  if (d == 0) return {0, n};
  const Word half = n >> 1U;
  int places = 0;
  for (; d <= half; ++places) d <<= 1U;
  Word quotient = 0;
  for (; places >= 0; --places, d >>= 1U) {
    quotient <<= 1U;
    if (n < d) continue;
    n -= d;
    quotient |= 1U;
  }
  return {quotient, n};
}

constexpr Divided<std::uint32_t> divide(std::uint32_t n, std::uint32_t d) { return divide_bits(n, d); }
/// Most that are typed as 64 bits are not that long.
constexpr Divided<std::uint64_t> divide(std::uint64_t n, std::uint64_t d) {
  if (((n | d) >> 32U) != 0) return divide_bits(n, d);
  const Divided<std::uint32_t> parts = divide(static_cast<std::uint32_t>(n), static_cast<std::uint32_t>(d));
  return {parts.quotient, parts.remainder};
}

/// Towards zero; the remainder has the sign of `n`.
template <std::signed_integral Int>
constexpr Divided<Int> divide(Int n, Int d) {
  using Word = std::make_unsigned_t<Int>;
  const auto amount = [](Int value) {
    return value < 0 ? Word{0} - static_cast<Word>(value) : static_cast<Word>(value);
  };
  const Divided<Word> parts = divide(amount(n), amount(d));
  const auto with_sign = [](Word value, bool negative) { return static_cast<Int>(negative ? Word{0} - value : value); };
  return {with_sign(parts.quotient, (n < 0) != (d < 0)), with_sign(parts.remainder, n < 0)};
}

}  // namespace fencepost::mcu::division
