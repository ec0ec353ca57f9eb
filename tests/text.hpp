// Looks into texts, for tests.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace fencepost::test {

/// Whether `part` is in `text`, which a failure shows.
inline testing::AssertionResult holds(std::string_view text, std::string_view part) {
  return testing::AssertionResult(text.find(part) != std::string_view::npos) << text;
}

/// How often `part` is in `text`.
inline std::size_t count(std::string_view text, std::string_view part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string_view::npos; at = text.find(part, at + part.size())) ++found;
  return found;
}

inline std::span<const std::uint8_t> octets(std::string_view text) {
  return {static_cast<const std::uint8_t*>(static_cast<const void*>(text.data())), text.size()};
}

}  // namespace fencepost::test
