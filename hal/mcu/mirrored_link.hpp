// Two byte links as one: a console that is mirrored on USB and on a serial line.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/base/result.hpp"
#include "hal/bus/byte_link.hpp"

namespace fencepost::mcu {

/// Requirement of MirroredLink on both: a ByteLink that says how much a write would take now; 0 while it is gone.
template <class T>
concept RoomyLink = bus::ByteLink<T> && requires(const T& link) {
  { link.room() } -> std::same_as<std::size_t>;
};

/// Writes everything to both links. One of them is the primary: the one that received input last. Initially, and
/// whenever the optional one is gone, it is the fixed one. A write answers what the primary took, so the primary's
/// back-pressure is the console's. The secondary gets whole lines while it has room for the longest line, and misses
/// the others. So a program that has a port open and does not read it blocks nobody. A primary that has taken nothing
/// for kWritesWithoutRoom writes becomes the secondary. Input comes from either link, but never from both within one
/// line. The other link is not read until the line has ended, or its writer has been silent for kSilence reads.
template <RoomyLink Fixed, RoomyLink Optional>
class MirroredLink {
 public:
  static constexpr std::size_t kLongestLine = 1024;
  static constexpr std::uint32_t kWritesWithoutRoom = 500;  ///< the loop makes several writes each millisecond
  static constexpr std::uint32_t kSilence = 2000;           ///< reads; a person pauses within a line, a record does not

  constexpr MirroredLink(Fixed& fixed, Optional& optional) : fixed_(fixed), optional_(optional) {}

  base::Result<std::size_t> read(std::span<std::uint8_t> in) {
    if (in.empty()) return std::size_t{0};
    base::Result<std::size_t> got = reading_optional_ ? read_from(optional_, in) : read_from(fixed_, in);
    if (got || got.error() == base::Error::kBadInput) return got;
    const bool may_change = !in_line_ || ++silent_ > kSilence || got.error() == base::Error::kGone;
    if (!may_change) return base::Error::kNotReady;
    got = reading_optional_ ? read_from(fixed_, in) : read_from(optional_, in);
    if (got) reading_optional_ = optional_is_primary_ = !reading_optional_;
    if (!got && got.error() == base::Error::kGone) return base::Error::kNotReady;  // only one of the two is
    return got;
  }

  base::Result<std::size_t> write(std::span<const std::uint8_t> out) {
    if (optional_is_primary_) {
      const base::Result<std::size_t> taken = optional_.write(out);
      if (taken || (taken.error() == base::Error::kFull && ++refused_ < kWritesWithoutRoom))
        return mirror(fixed_, taken, out);
      optional_is_primary_ = false;
    }
    return mirror(optional_, fixed_.write(out), out);
  }

  /// Once, after somebody has come to the optional link: what was said before was not heard there.
  [[nodiscard]] bool take_opened() requires requires(Optional& link) { link.take_opened(); }
  { return optional_.take_opened(); }
  /// Once, after the optional link is gone.
  [[nodiscard]] bool take_gone() requires requires(Optional& link) { link.take_gone(); }
  { return optional_.take_gone(); }

 private:
  template <class Link>
  base::Result<std::size_t> read_from(Link& link, std::span<std::uint8_t> in) {
    const base::Result<std::size_t> got = link.read(in);
    if (!got || *got == 0) return got;
    silent_ = 0;
    const std::uint8_t last = in[*got - 1];
    in_line_ = last != '\r' && last != '\n';
    return got;
  }

  // The same bytes for the secondary link.
  template <class Link>
  base::Result<std::size_t> mirror(Link& link, base::Result<std::size_t> taken, std::span<const std::uint8_t> out) {
    if (!taken) return taken;
    refused_ = 0;
    for (auto rest = out.first(*taken); !rest.empty();) {
      if (at_line_start_) mirroring_ = link.room() >= kLongestLine;
      const auto end = std::ranges::find(rest, std::uint8_t{'\n'});
      at_line_start_ = end != rest.end();
      const auto line = rest.first(static_cast<std::size_t>(end - rest.begin()) + (at_line_start_ ? 1 : 0));
      if (mirroring_) mirroring_ = link.write(line).ok();
      rest = rest.subspan(line.size());
    }
    return taken;
  }

  Fixed& fixed_;
  Optional& optional_;
  bool optional_is_primary_ = false;
  bool reading_optional_ = false;
  bool in_line_ = false;
  bool at_line_start_ = true;
  bool mirroring_ = false;
  std::uint32_t silent_ = 0;
  std::uint32_t refused_ = 0;
};

}  // namespace fencepost::mcu
