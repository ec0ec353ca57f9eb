// IEEE 754 binary32 in integers, for cores without a float unit. Rounded to nearest even, denormals included: the same
// bits as any float unit gives. For cores without long multiplication and division (Cortex-M0) the compiler's is three
// to eight times slower, and twice as large.
#pragma once

#include <array>
#include <cstdint>

namespace fencepost::mcu::soft {

/// A float's bits: sign, eight of exponent, 23 of fraction.
using Bits = std::uint32_t;

inline constexpr Bits kSign = 0x8000'0000;
inline constexpr Bits kInfinity = 0x7F80'0000;
inline constexpr Bits kNan = 0x7FC0'0000;
inline constexpr std::uint32_t kHidden = 1U << 23;  // the leading one, which is not stored

constexpr std::uint32_t exponent(Bits x) { return (x << 1) >> 24; }
constexpr std::uint32_t fraction(Bits x) { return (x << 9) >> 9; }
constexpr bool is_nan(Bits x) { return (x << 1) > (kInfinity << 1); }
constexpr bool is_zero(Bits x) { return (x << 1) == 0; }
/// Neither zero nor denormal nor infinite nor no number.
constexpr bool is_normal(std::uint32_t exponent_of) { return exponent_of - 1 < 254; }

/// Extra bits of a significand that rounding has yet to shorten from 24 bits. The last is set if anything was lost.
inline constexpr int kGuards = 3;
inline constexpr std::uint32_t kLeading = kHidden << kGuards;  ///< leading one of such a significand

constexpr std::uint32_t round_guards(std::uint32_t significand) {
  return (significand + 3 + ((significand >> kGuards) & 1)) >> kGuards;
}

/// The same shifted down; what leaves is kept in the last bit.
constexpr std::uint32_t shift_out(std::uint32_t value, std::uint32_t places) {
  if (places > 31) return value != 0 ? 1 : 0;
  const std::uint32_t kept = value >> places;
  return (kept << places) == value ? kept : kept | 1;
}

/// Where the exponent may have left its range.
[[gnu::noinline]] constexpr Bits pack_anywhere(Bits sign, std::int32_t exponent_of, std::uint32_t significand) {
  if (exponent_of >= 255) return sign | kInfinity;
  if (exponent_of >= 1) return sign | ((static_cast<Bits>(exponent_of - 1) << 23) + round_guards(significand));
  return sign | round_guards(shift_out(significand, static_cast<std::uint32_t>(1 - exponent_of)));
}

/// `significand` has its leading one at kLeading. The sum carries into the exponent where rounding does.
constexpr Bits pack(Bits sign, std::int32_t exponent_of, std::uint32_t significand) {
  if (static_cast<std::uint32_t>(exponent_of - 1) >= 254) return pack_anywhere(sign, exponent_of, significand);
  return sign | ((static_cast<Bits>(exponent_of - 1) << 23) + round_guards(significand));
}

/// Sign aside, a normal or denormal number as a significand with its leading one at kHidden.
struct Parts {
  std::int32_t exponent = 0;
  std::uint32_t significand = 0;
};

constexpr Parts take_apart(Bits x) {
  Parts parts{static_cast<std::int32_t>(exponent(x)), fraction(x)};
  if (parts.exponent != 0) {
    parts.significand |= kHidden;
    return parts;
  }
  for (parts.exponent = 1; parts.significand < kHidden; --parts.exponent) parts.significand <<= 1;
  return parts;
}

// --- addition ---

/// Not finite numbers, and zeros beside them; |a| >= |b|.
[[gnu::noinline]] constexpr Bits add_special(Bits a, Bits b) {
  if (is_nan(a) || is_nan(b)) return kNan;
  if (exponent(a) == 255) return exponent(b) == 255 && a != b ? kNan : a;
  return is_zero(a) ? a & b : a;  // b is zero
}

/// The leading one of `m` goes to kLeading, but not below the least exponent; m is not zero.
constexpr Bits pack_difference(Bits sign, std::int32_t exponent_of, std::uint32_t m) {
  for (; m < (kLeading >> 7); exponent_of -= 8) m <<= 8;
  for (; m < kLeading; --exponent_of) m <<= 1;
  return pack(sign, exponent_of, m);
}

constexpr Bits add(Bits a, Bits b) {
  if ((a << 1) < (b << 1)) {
    const Bits other = a;
    a = b;
    b = other;
  }
  std::uint32_t exponent_a = exponent(a);
  std::uint32_t exponent_b = exponent(b);
  std::uint32_t m = fraction(a) | kHidden;
  std::uint32_t n = fraction(b) | kHidden;
  if (exponent_b == 0) {
    if (is_zero(b) || exponent_a == 255) return add_special(a, b);
    n ^= kHidden;
    exponent_b = 1;
    if (exponent_a == 0) {
      m ^= kHidden;
      exponent_a = 1;
    }
  }
  if (exponent_a == 255) return add_special(a, b);
  m <<= kGuards;
  n <<= kGuards;
  if (const std::uint32_t places = exponent_a - exponent_b; places != 0) n = shift_out(n, places);
  const Bits sign = a & kSign;
  auto exponent_of = static_cast<std::int32_t>(exponent_a);
  if (((a ^ b) & kSign) == 0) {
    m += n;
    if (m >= 2 * kLeading) {
      m = (m >> 1) | (m & 1);
      ++exponent_of;
    } else if (m < kLeading) {
      return sign | (m >> kGuards);  // both denormal
    }
    return pack(sign, exponent_of, m);
  }
  m -= n;
  if (m >= kLeading) return pack(sign, exponent_of, m);
  return m == 0 ? 0 : pack_difference(sign, exponent_of, m);
}

constexpr Bits subtract(Bits a, Bits b) { return add(a, b ^ kSign); }

// --- multiplication ---

/// Of two significands with the leading one at kHidden: the exact product's upper 32 of 48 bits. The last of them is
/// set if there was more.
constexpr std::uint32_t upper_product(std::uint32_t m, std::uint32_t n) {
  const std::uint32_t m_high = m >> 8;
  const std::uint32_t n_high = n >> 8;
  const std::uint32_t m_low = m & 0xFF;
  const std::uint32_t n_low = n & 0xFF;
  const std::uint32_t low = m_low * n_low;
  const std::uint32_t middle = m_high * n_low + m_low * n_high + (low >> 8);
  const std::uint32_t rest = (middle | low) & 0xFF;
  const std::uint32_t upper = m_high * n_high + (middle >> 8);
  return rest != 0 ? upper | 1 : upper;
}

constexpr Bits multiply_parts(Bits sign, Parts a, Parts b) {
  std::uint32_t m = upper_product(a.significand, b.significand);
  std::int32_t exponent_of = a.exponent + b.exponent - 127;
  if (m >= kSign) {
    ++exponent_of;
    m = (m >> 5) | ((m & 0x1F) != 0 ? 1U : 0U);
  } else {
    m = (m >> 4) | ((m & 0xF) != 0 ? 1U : 0U);
  }
  return pack(sign, exponent_of, m);
}

[[gnu::noinline]] constexpr Bits multiply_special(Bits a, Bits b) {
  const Bits sign = (a ^ b) & kSign;
  if (is_nan(a) || is_nan(b)) return kNan;
  if (exponent(a) == 255 || exponent(b) == 255) return is_zero(a) || is_zero(b) ? kNan : sign | kInfinity;
  if (is_zero(a) || is_zero(b)) return sign;
  return multiply_parts(sign, take_apart(a), take_apart(b));
}

constexpr Bits multiply(Bits a, Bits b) {
  const std::uint32_t exponent_a = exponent(a);
  const std::uint32_t exponent_b = exponent(b);
  if (!is_normal(exponent_a) || !is_normal(exponent_b)) return multiply_special(a, b);
  return multiply_parts((a ^ b) & kSign, {static_cast<std::int32_t>(exponent_a), fraction(a) | kHidden},
                        {static_cast<std::int32_t>(exponent_b), fraction(b) | kHidden});
}

// --- division ---

/// 2^31 / d for the middle of each of 128 ranges of 16-bit d with the leading bit set.
inline constexpr std::array<std::uint16_t, 128> kReciprocals = [] {
  std::array<std::uint16_t, 128> table{};
  for (std::uint32_t i = 0; i < table.size(); ++i) {
    table[i] = static_cast<std::uint16_t>((1U << 31) / ((128 + i) * 256 + 128));
  }
  return table;
}();

/// Of d, 16 bits with the leading one set: at most 2^31 / (d + 1), and at most 6 less. A look-up and one step of
/// Newton.
constexpr std::uint32_t reciprocal(std::uint32_t d) {
  const std::uint32_t guess = kReciprocals[(d >> 8) - 128];
  const auto error = static_cast<std::int32_t>((1U << 31) - d * guess) >> 8;
  return guess + static_cast<std::uint32_t>((static_cast<std::int32_t>(guess) * error) >> 23) - 3;
}

constexpr Bits divide_parts(Bits sign, Parts a, Parts b) {
  std::uint32_t rest = a.significand;
  const std::uint32_t d = b.significand;
  std::int32_t exponent_of = a.exponent - b.exponent + 127;
  if (rest < d) {
    rest <<= 1;
    --exponent_of;
  }
  // Two digits of 13 bits, neither too large, the second made exact. Remainders fit into 32 bits, products need not.
  const std::uint32_t inverse = reciprocal(d >> 8);
  std::uint32_t quotient = ((rest >> 9) * inverse) >> 18;
  rest = (rest << 12) - quotient * d;
  const std::uint32_t digit = ((rest >> 10) * inverse) >> 16;
  rest = (rest << 13) - digit * d;
  quotient = (quotient << 13) + digit;
  for (; rest >= d; rest -= d) ++quotient;
  if (static_cast<std::uint32_t>(exponent_of - 1) >= 254) {
    return pack_anywhere(sign, exponent_of, (quotient << 1) | (rest != 0 ? 1U : 0U));
  }
  // Never half way between two floats: that quotient's 25 bits, times the divisor, were more than the dividend's 24.
  return sign | ((static_cast<Bits>(exponent_of - 1) << 23) + ((quotient + 2) >> 2));
}

[[gnu::noinline]] constexpr Bits divide_special(Bits a, Bits b) {
  const Bits sign = (a ^ b) & kSign;
  if (is_nan(a) || is_nan(b)) return kNan;
  if (exponent(a) == 255) return exponent(b) == 255 ? kNan : sign | kInfinity;
  if (exponent(b) == 255) return sign;
  if (is_zero(b)) return is_zero(a) ? kNan : sign | kInfinity;
  if (is_zero(a)) return sign;
  return divide_parts(sign, take_apart(a), take_apart(b));
}

constexpr Bits divide(Bits a, Bits b) {
  const std::uint32_t exponent_a = exponent(a);
  const std::uint32_t exponent_b = exponent(b);
  if (!is_normal(exponent_a) || !is_normal(exponent_b)) return divide_special(a, b);
  return divide_parts((a ^ b) & kSign, {static_cast<std::int32_t>(exponent_a), fraction(a) | kHidden},
                      {static_cast<std::int32_t>(exponent_b), fraction(b) | kHidden});
}

// --- square root ---

constexpr std::uint32_t slow_root(std::uint64_t of) {
  std::uint64_t root = 0;
  for (std::uint64_t bit = 1ULL << 31; bit != 0; bit >>= 1) {
    if ((root + bit) * (root + bit) <= of) root += bit;
  }
  return static_cast<std::uint32_t>(root);
}

/// 2^28 / sqrt(m) for the middle of each of 96 ranges of m, 2^24 to 2^26.
inline constexpr std::array<std::uint16_t, 96> kInverseRoots = [] {
  std::array<std::uint16_t, 96> table{};
  for (std::uint32_t i = 0; i < table.size(); ++i) {
    const std::uint64_t middle = ((32 + i) << 19) + (1U << 18);
    table[i] = static_cast<std::uint16_t>((1ULL << 43) / slow_root(middle << 30));
  }
  return table;
}();

/// Twice floor(2^13 sqrt(m)); the last bit is set if there was more; m from 2^24 to 2^26. Newton's step on the inverse
/// root, one on the root, then exact: the remainder of a root that is slightly off fits into 32 bits.
constexpr std::uint32_t root_with_rest(std::uint32_t m) {
  std::uint32_t y = kInverseRoots[(m >> 19) - 32];
  const std::uint32_t upper = m >> 10;
  const auto off = static_cast<std::int32_t>((1U << 30) - upper * ((y * y) >> 16)) >> 10;
  y += static_cast<std::uint32_t>((static_cast<std::int32_t>(y) * off) >> 21);
  const std::uint32_t first = (upper * y) >> 15;
  const auto left = static_cast<std::int32_t>((m << 6) - first * first) >> 5;
  std::uint32_t root = (first << 10) + static_cast<std::uint32_t>((left * static_cast<std::int32_t>(y)) >> 17);
  auto rest = static_cast<std::int32_t>((m << 26) - root * root);
  while (rest < 0) {
    --root;
    rest += static_cast<std::int32_t>(2 * root + 1);
  }
  while (rest > static_cast<std::int32_t>(2 * root)) {
    rest -= static_cast<std::int32_t>(2 * root + 1);
    ++root;
  }
  return (root << 1) | (rest != 0 ? 1U : 0U);
}

constexpr Bits root(Bits x) {
  if (is_zero(x) || x == kInfinity) return x;
  if (is_nan(x) || (x & kSign) != 0) return kNan;
  Parts parts = take_apart(x);
  const bool odd = (parts.exponent & 1) != 0;  // 127 is: then the true exponent is even
  const std::uint32_t m = parts.significand << (odd ? 1 : 2);
  const std::int32_t exponent_of = (parts.exponent + (odd ? 127 : 126)) >> 1;
  return pack(0, exponent_of, root_with_rest(m));
}

// --- comparison ---

/// In the order of the numbers they stand for, if neither is a NaN and not both are zero.
constexpr std::int32_t rank(Bits x) {
  return (x & kSign) != 0 ? -static_cast<std::int32_t>(x & ~kSign) : static_cast<std::int32_t>(x);
}
constexpr bool unordered(Bits a, Bits b) { return is_nan(a) || is_nan(b); }
constexpr bool both_positive(Bits a, Bits b) { return ((a | b) & kSign) == 0; }
constexpr bool less(Bits a, Bits b) {
  if (both_positive(a, b)) return a < b && b <= kInfinity;
  return !unordered(a, b) && rank(a) < rank(b);
}
constexpr bool less_or_equal(Bits a, Bits b) {
  if (both_positive(a, b)) return a <= b && b <= kInfinity;
  return !unordered(a, b) && rank(a) <= rank(b);
}
constexpr bool equal(Bits a, Bits b) { return !unordered(a, b) && rank(a) == rank(b); }

// --- integers ---

template <int kPlaces>
constexpr void skip_zeros(std::uint32_t& value, std::uint32_t& exponent_of) {
  if ((value >> (32 - kPlaces)) != 0) return;
  value <<= kPlaces;
  exponent_of -= kPlaces;
}

// Not inlined: one copy for four conversions.
[[gnu::noinline]] constexpr Bits from_unsigned(std::uint32_t value, Bits sign = 0) {
  if (value == 0) return 0;
  std::uint32_t exponent_of = 127 + 31;
  skip_zeros<16>(value, exponent_of);
  skip_zeros<8>(value, exponent_of);
  skip_zeros<4>(value, exponent_of);
  skip_zeros<2>(value, exponent_of);
  skip_zeros<1>(value, exponent_of);
  std::uint32_t significand = value >> 8;
  if (const std::uint32_t lost = value & 0xFF; lost != 0) significand += (lost + 0x7F + (significand & 1)) >> 8;
  return sign | (((exponent_of - 1) << 23) + significand);
}
constexpr Bits from_signed(std::int32_t value) {
  const auto bits = static_cast<std::uint32_t>(value);
  return from_unsigned(value < 0 ? -bits : bits, bits & kSign);
}
constexpr Bits from_unsigned64(std::uint64_t value, Bits sign = 0) {
  std::int32_t halvings = 0;
  bool lost = false;
  for (; (value >> 32) != 0; ++halvings) {
    lost = lost || (value & 1) != 0;
    value >>= 1;
  }
  // 32 bits hold more than rounding asks of them, so a last bit for what was lost changes nothing else.
  const Bits x = from_unsigned(static_cast<std::uint32_t>(value) | (lost ? 1U : 0U), sign);
  return x + (static_cast<Bits>(halvings) << 23);
}
constexpr Bits from_signed64(std::int64_t value) {
  const auto bits = static_cast<std::uint64_t>(value);
  return from_unsigned64(value < 0 ? -bits : bits, static_cast<Bits>(bits >> 32) & kSign);
}

/// Towards zero; the amount alone. What does not fit is the caller's mistake and gives anything.
constexpr std::uint64_t amount64(Bits x) {
  const auto places = static_cast<std::int32_t>(exponent(x)) - 127 - 23;
  const std::uint64_t significand = fraction(x) | kHidden;
  if (places < -23) return 0;
  if (places < 0) return significand >> -places;
  return places > 40 ? ~0ULL : significand << places;
}
constexpr std::uint32_t amount(Bits x) {
  const auto places = static_cast<std::int32_t>(exponent(x)) - 127 - 23;
  const std::uint32_t significand = fraction(x) | kHidden;
  if (places < -23) return 0;
  if (places < 0) return significand >> -places;
  return places > 8 ? ~0U : significand << places;
}

}  // namespace fencepost::mcu::soft
