// The self-test's inputs, and what must come of them. The same records are host/share/recordings/selftest.log, so the
// desk can be asked for the same digest: `fencepost replay selftest.log --profile micro`.
#pragma once

#include <cstdint>
#include <string_view>

#include "firmware/config/profile.hpp"

namespace fencepost::app {

struct CannedStream {
  std::string_view lines;    ///< each ends with '\n'
  std::uint64_t digest = 0;  ///< state digest after the last of them
};

/// Record lines: a camera and three dozen frames of a drive around two objects.
extern const std::string_view kCannedLines;

/// By profile: they keep different numbers of objects, vertices and cells. A change of the reconstruction changes
/// these; tests/firmware/app/selftest_test.cpp then prints the new ones.
template <class Profile>
inline constexpr std::uint64_t kCannedDigest = 0;
template <>
inline constexpr std::uint64_t kCannedDigest<config::Micro> = 0x65363978e6db04af;
template <>
inline constexpr std::uint64_t kCannedDigest<config::Small> = 0xad9178cef7115f37;
template <>
inline constexpr std::uint64_t kCannedDigest<config::Full> = 0x7e71f5cc49c3ebc7;

template <class Profile>
CannedStream canned_stream() {
  return {kCannedLines, kCannedDigest<Profile>};
}

}  // namespace fencepost::app
