// One line for people, written into given room. What does not fit makes it void, never cut.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "hal/base/units.hpp"

namespace fencepost::console {

/// Half away from zero. by > 0.
constexpr std::int64_t divide_rounded(std::int64_t value, std::int64_t by) {
  return (value < 0 ? value - by / 2 : value + by / 2) / by;
}

class Sentence {
 public:
  explicit Sentence(std::span<char> out) : out_(out) {}

  Sentence& put(std::string_view text);
  /// Counts of 10^-decimals.
  Sentence& number(std::int64_t raw, unsigned decimals = 0);
  /// Ends at `column`, or later if the columns before it are taken.
  Sentence& number_to(std::size_t column, std::int64_t raw, unsigned decimals = 0);
  /// Two decimals.
  Sentence& metres(base::Metres length);
  Sentence& metres_to(std::size_t column, base::Metres length);
  /// "12 deg left", "ahead", "behind".
  Sentence& bearing(base::Radians bearing);
  /// 16 lower-case hex digits.
  Sentence& digest(std::uint64_t value);
  Sentence& pad_to(std::size_t column);
  /// At least one space, then up to `column`.
  Sentence& gap_to(std::size_t column);
  [[nodiscard]] std::size_t column() const { return size_; }

  /// Adds the line end; the length, or 0 if the room was too small.
  std::size_t end();

 private:
  std::span<char> out_;
  std::size_t size_ = 0;
};

/// Whole degrees, half away from zero.
constexpr std::int64_t whole_degrees(base::Radians angle) {
  return divide_rounded(static_cast<std::int64_t>(angle.raw) * 180, 31416);
}

}  // namespace fencepost::console
