#include "firmware/record/decimal.hpp"

#include "hal/base/check.hpp"

namespace fencepost::record {
namespace {

/// Above every range, and ten times it still fits: digits beyond are read and change nothing.
constexpr std::uint64_t kSaturated = 10'000'000'000'000'000;

constexpr std::uint64_t append_digit(std::uint64_t magnitude, unsigned digit) {
  return magnitude > kSaturated ? magnitude : magnitude * 10 + digit;
}

}  // namespace

base::Result<std::int64_t, Reject> read_decimal(std::string_view text, const NumberField& field) {
  const bool negative = text.starts_with('-');
  if (negative) text.remove_prefix(1);
  std::uint64_t magnitude = 0;
  unsigned whole_digits = 0;
  unsigned decimals = 0;
  bool point = false;
  bool round_up = false;
  for (const char c : text) {
    if (c == '.' && !point) {
      point = true;
      continue;
    }
    if (c < '0' || c > '9') return Reject::kNumber;
    const auto digit = static_cast<unsigned>(c - '0');
    ++(point ? decimals : whole_digits);
    if (decimals <= field.decimals) {
      magnitude = append_digit(magnitude, digit);
    } else if (decimals == field.decimals + 1U) {
      round_up = digit >= 5;  // the digits after this one cannot change the direction
    }
  }
  if (whole_digits == 0 || (point && decimals == 0)) return Reject::kNumber;
  for (; decimals < field.decimals; ++decimals) magnitude = append_digit(magnitude, 0);
  if (round_up) ++magnitude;
  const auto value = static_cast<std::int64_t>(magnitude);
  const std::int64_t raw = negative ? -value : value;
  if (raw < field.min || raw > field.max) return Reject::kRange;
  return raw;
}

std::optional<std::int64_t> read_plain(std::string_view& rest, const NumberField& field) {
  constexpr std::ptrdiff_t kMaxDigits = 18;
  const char* const end = rest.data() + rest.size();
  const bool negative = rest.starts_with('-');
  const char* at = rest.data() + (negative ? 1 : 0);
  std::uint64_t magnitude = 0;  // of too many digits it is wrong, and not used
  const auto digits = [&] {
    const char* const first = at;
    for (; at != end && *at >= '0' && *at <= '9'; ++at) magnitude = magnitude * 10 + static_cast<unsigned>(*at - '0');
    return at - first;
  };
  const std::ptrdiff_t whole_digits = digits();
  std::ptrdiff_t missing = field.decimals;
  if (whole_digits == 0 || whole_digits + missing > kMaxDigits) return std::nullopt;
  if (at != end && *at == '.') {
    ++at;
    const std::ptrdiff_t decimals = digits();
    if (decimals == 0 || decimals > missing) return std::nullopt;
    missing -= decimals;
  }
  if (at != end && *at != ',') return std::nullopt;
  for (; missing > 0; --missing) magnitude *= 10;
  const auto value = static_cast<std::int64_t>(magnitude);
  const std::int64_t raw = negative ? -value : value;
  if (raw < field.min || raw > field.max) return std::nullopt;
  rest.remove_prefix(static_cast<std::size_t>(at - rest.data()) + (at != end ? 1 : 0));
  return raw;
}

std::size_t write_decimal(std::int64_t raw, unsigned decimals, std::span<char> out) {
  FENCEPOST_CHECK(out.size() >= kMaxDecimal);
  char reversed[kMaxDecimal];
  std::size_t size = 0;
  auto rest = static_cast<std::uint64_t>(raw < 0 ? -raw : raw);
  for (unsigned digits = 0; digits <= decimals || rest != 0; ++digits) {
    if (decimals != 0 && digits == decimals) reversed[size++] = '.';
    reversed[size++] = static_cast<char>('0' + rest % 10);
    rest /= 10;
  }
  if (raw < 0) reversed[size++] = '-';
  for (std::size_t i = 0; i < size; ++i) out[i] = reversed[size - 1 - i];
  return size;
}

}  // namespace fencepost::record
