// Two byte links as one: a console that is on USB and on a serial line at the same time.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/base/result.hpp"
#include "hal/bus/byte_link.hpp"

namespace fencepost::mcu {

/// What TwinLink wants of each: a ByteLink that says how much a write would take now; 0 while it is gone.
template <class T>
concept RoomyLink = bus::ByteLink<T> && requires(const T& link) {
  { link.room() } -> std::same_as<std::size_t>;
};

/// Says everything on both. One of them leads: the one on which something was typed last, at first and whenever the
/// other is gone the steady one. It is the leader that is written to as ByteLink says, so its pace is the console's.
/// The other gets whole lines as it has room for the longest, and misses those for which it has none: a program that
/// has a port open and does not read it holds nobody up. A leader that has taken nothing for so many writes does not
/// lead any longer. Reads come from either, never from both in one line: the other waits until the line is over, or its
/// writer silent.
template <RoomyLink Steady, RoomyLink Guest>
class TwinLink {
 public:
  static constexpr std::size_t kLongestLine = 1024;
  static constexpr std::uint32_t kPatience = 500;  ///< writes without room; the loop makes some each millisecond
  static constexpr std::uint32_t kSilence = 2000;  ///< reads; a person pauses in a line, a record does not

  constexpr TwinLink(Steady& steady, Guest& guest) : steady_(steady), guest_(guest) {}

  base::Result<std::size_t> read(std::span<std::uint8_t> in) {
    if (in.empty()) return std::size_t{0};
    base::Result<std::size_t> got = guest_reads_ ? read_from(guest_, in) : read_from(steady_, in);
    if (got || got.error() == base::Error::kBadInput) return got;
    const bool may_change = !in_line_ || ++silent_ > kSilence || got.error() == base::Error::kGone;
    if (!may_change) return base::Error::kNotReady;
    got = guest_reads_ ? read_from(steady_, in) : read_from(guest_, in);
    if (got) guest_reads_ = guest_leads_ = !guest_reads_;
    if (!got && got.error() == base::Error::kGone) return base::Error::kNotReady;  // only one of the two is
    return got;
  }

  base::Result<std::size_t> write(std::span<const std::uint8_t> out) {
    if (guest_leads_) {
      const base::Result<std::size_t> taken = guest_.write(out);
      if (taken || (taken.error() == base::Error::kFull && ++refused_ < kPatience)) return follow(steady_, taken, out);
      guest_leads_ = false;
    }
    return follow(guest_, steady_.write(out), out);
  }

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

  // The same bytes for the one that does not lead.
  template <class Link>
  base::Result<std::size_t> follow(Link& link, base::Result<std::size_t> taken, std::span<const std::uint8_t> out) {
    if (!taken) return taken;
    refused_ = 0;
    for (auto rest = out.first(*taken); !rest.empty();) {
      if (at_begin_) follows_ = link.room() >= kLongestLine;
      const auto end = std::ranges::find(rest, std::uint8_t{'\n'});
      at_begin_ = end != rest.end();
      const auto line = rest.first(static_cast<std::size_t>(end - rest.begin()) + (at_begin_ ? 1 : 0));
      if (follows_) follows_ = link.write(line).ok();
      rest = rest.subspan(line.size());
    }
    return taken;
  }

  Steady& steady_;
  Guest& guest_;
  bool guest_leads_ = false;
  bool guest_reads_ = false;
  bool in_line_ = false;
  bool at_begin_ = true;
  bool follows_ = false;
  std::uint32_t silent_ = 0;
  std::uint32_t refused_ = 0;
};

}  // namespace fencepost::mcu
