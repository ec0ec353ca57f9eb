#include "firmware/console/sentence.hpp"

#include <array>

#include "firmware/record/decimal.hpp"
#include "firmware/record/text.hpp"

namespace fencepost::console {
namespace {

// Directions within this of straight ahead or behind have no side (degrees).
constexpr std::int64_t kNoSide = 2;
// A length in 0.1 mm to one in cm.
constexpr std::int64_t kPerCentimetre = 100;

}  // namespace

Sentence& Sentence::put(std::string_view text) {
  for (const char c : text) {
    if (size_ < out_.size()) out_[size_] = c;
    ++size_;
  }
  return *this;
}

Sentence& Sentence::number(std::int64_t raw, unsigned decimals) { return number_to(0, raw, decimals); }

Sentence& Sentence::number_to(std::size_t column, std::int64_t raw, unsigned decimals) {
  std::array<char, record::kMaxDecimal> digits{};
  const std::size_t size = record::write_decimal(raw, decimals, digits);
  while (size_ + size < column) put(" ");
  return put({digits.data(), size});
}

Sentence& Sentence::metres(base::Metres length) { return metres_to(0, length); }

Sentence& Sentence::metres_to(std::size_t column, base::Metres length) {
  return number_to(column, divide_rounded(length.raw, kPerCentimetre), 2);
}

Sentence& Sentence::bearing(base::Radians bearing) {
  const std::int64_t degrees = whole_degrees(bearing);
  const std::int64_t size = degrees < 0 ? -degrees : degrees;
  if (size <= kNoSide) return put("ahead");
  if (size >= 180 - kNoSide) return put("behind");
  return number(size).put(degrees > 0 ? " deg left" : " deg right");
}

Sentence& Sentence::digest(std::uint64_t value) {
  for (unsigned shift = 4 * record::kDigestDigits; shift != 0; shift -= 4) {
    const char digit = record::kLowerHex[(value >> (shift - 4)) & 0xFU];
    put({&digit, 1});
  }
  return *this;
}

Sentence& Sentence::pad_to(std::size_t column) {
  while (size_ < column) put(" ");
  return *this;
}

Sentence& Sentence::gap_to(std::size_t column) { return put(" ").pad_to(column); }

std::size_t Sentence::end() {
  put("\r\n");
  return size_ <= out_.size() ? size_ : 0;
}

}  // namespace fencepost::console
