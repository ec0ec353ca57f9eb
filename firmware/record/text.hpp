// Characters and hex numbers on a line.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace fencepost::record {

inline constexpr char kEscape = '%';  ///< then two hex digits: any byte
inline constexpr unsigned kCrcDigits = 4;
inline constexpr unsigned kDigestDigits = 16;

/// Printable ASCII but the characters with a meaning of their own; all others are escaped.
constexpr bool stands_for_itself(char c) {
  return c >= ' ' && c <= '~' && c != ',' && c != '*' && c != '$' && c != kEscape;
}

/// The text after the first `at` characters. Not substr(): that one links an exception's machinery.
constexpr std::string_view after(std::string_view text, std::size_t at) {
  text.remove_prefix(std::min(at, text.size()));
  return text;
}

/// The characters up to the first `end`, or all.
constexpr std::string_view before(std::string_view text, char end) {
  return {text.data(), std::min(text.find(end), text.size())};
}

}  // namespace fencepost::record
