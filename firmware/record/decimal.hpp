// Plain decimals and hex digits, exact: text to scaled integers and back, never through floating point.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "firmware/record/records.hpp"
#include "hal/base/result.hpp"

namespace fencepost::record {

/// The range of a number field, in units of its last decimal.
struct NumberField {
  std::int64_t min;
  std::int64_t max;
  std::uint8_t decimals;
};

/// `-?digits[.digits]` with any number of digits, rounded to the field's decimals, half away from zero; the range
/// holds for the rounded value.
/// errors: number (malformed, empty), range
base::Result<std::int64_t, Reject> read_decimal(std::string_view text, const NumberField& field);

/// The same of the field at the front of `rest`, if it is as writers write it. It has at most 18 digits, no decimals
/// beyond the field's, and is inside the range. Steps over it and its comma. Else nothing: read_decimal() says why.
std::optional<std::int64_t> read_plain(std::string_view& rest, const NumberField& field);

inline constexpr std::size_t kMaxDecimal = 21;  ///< characters of any int64 with sign and point

/// Exactly `decimals` decimals; no '+' and no negative zero. `out` holds at least kMaxDecimal characters.
/// Returns the length. |raw| < 2^63.
std::size_t write_decimal(std::int64_t raw, unsigned decimals, std::span<char> out);

/// Value of a hex digit of either case, or -1.
constexpr int hex_value(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return -1;
}

inline constexpr std::string_view kUpperHex = "0123456789ABCDEF";
inline constexpr std::string_view kLowerHex = "0123456789abcdef";

}  // namespace fencepost::record
