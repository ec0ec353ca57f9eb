// The self-test's inputs, and what must come of them. The same records are host/share/recordings/selftest.log, so the
// desk can be asked for the same digest: `fencepost replay selftest.log --profile micro`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "firmware/config/profile.hpp"
#include "firmware/loop/packed_lines.hpp"

namespace fencepost::loop {

inline constexpr std::size_t kLongestCannedLine = 112;  ///< without its end

struct CannedStream {
  std::span<const std::uint8_t> packed;  ///< lines of at most kLongestCannedLine, see pack_lines
  std::uint64_t digest = 0;              ///< state digest after the last of them
};

/// Record lines: a camera and two dozen frames of a drive around two objects.
extern const std::string_view kCannedLines;
extern const std::span<const std::uint8_t> kPackedLines;  ///< the same, packed; an image contains only these

/// By profile: they keep different numbers of objects, vertices and cells. A change of the reconstruction changes
/// these; tests/firmware/loop/selftest_test.cpp then prints the new ones.
template <class Profile>
inline constexpr std::uint64_t kCannedDigest = 0;
template <>
inline constexpr std::uint64_t kCannedDigest<config::Micro> = 0x6caef2186f6e0a96;
template <>
inline constexpr std::uint64_t kCannedDigest<config::Small> = 0x314955c03256ee41;
template <>
inline constexpr std::uint64_t kCannedDigest<config::Full> = 0x4bc1fbd5901edec7;

template <class Profile>
CannedStream canned_stream() {
  return {kPackedLines, kCannedDigest<Profile>};
}

}  // namespace fencepost::loop
