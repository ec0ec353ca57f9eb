// Sizes as people write them: 4096, 512K, 64M, 2G.
#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>

namespace fencepost::host::cli {

/// Bytes; K, M and G are powers of 1024, in either case. Empty if it is no such size, 0, or more than 2^63.
inline std::optional<std::uint64_t> size_in(std::string_view text) {
  constexpr std::string_view kUnits = "KMGkmg";
  unsigned shift = 0;
  if (!text.empty()) {
    const std::size_t unit = kUnits.find(text.back());
    if (unit != std::string_view::npos) {
      shift = 10 * (static_cast<unsigned>(unit) % 3 + 1);
      text.remove_suffix(1);
    }
  }
  std::uint64_t value = 0;
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value);
  constexpr std::uint64_t kMax = std::uint64_t{1} << 63U;
  if (error != std::errc() || stopped != end || value == 0 || value > kMax >> shift) return std::nullopt;
  return value << shift;
}

}  // namespace fencepost::host::cli
