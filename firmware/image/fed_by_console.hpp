// Sensors whose records come over the console: the loop reads them there, these only report the state of the link.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "firmware/console/counters.hpp"
#include "firmware/console/link_words.hpp"
#include "hal/base/units.hpp"
#include "hal/sensor/sources.hpp"

namespace fencepost::image {

/// Silent until a count changes, and again when it has not changed for a second.
class CountWatch {
 public:
  static constexpr base::Duration kSilentAfter = base::milliseconds(1'000);

  void watch(std::uint32_t count, base::Time now) {
    if (count == count_ && moved_at_ && now - *moved_at_ < kSilentAfter) return;
    if (count == count_) {
      moved_at_.reset();
    } else {
      moved_at_ = now;
    }
    count_ = count;
  }
  [[nodiscard]] sensor::LinkState link() const {
    return moved_at_ ? sensor::LinkState::kOk : sensor::LinkState::kSilent;
  }

 private:
  std::uint32_t count_ = 0;
  std::optional<base::Time> moved_at_;
};

/// Power and wires are those of the console, which works: the sender is missing. `remedy` names it.
inline console::LinkWords sent_link_words(std::string_view name, sensor::LinkState state, std::string_view remedy) {
  if (state != sensor::LinkState::kSilent) return console::plain_link_words(name, state);
  return {name, name, "no records", remedy};
}

class CameraOnConsole {
 public:
  explicit CameraOnConsole(const console::Counters& counters) : counters_(counters) {}

  base::Result<sensor::BlobFrame> poll(base::Time now) {
    watch_.watch(counters_.frames + counters_.refused_in_all(), now);
    return base::Error::kNotReady;
  }
  [[nodiscard]] sensor::LinkState link() const { return watch_.link(); }
  [[nodiscard]] static std::uint32_t dropped() { return 0; }
  [[nodiscard]] static bool stamped_here() { return false; }
  [[nodiscard]] static console::LinkWords link_words(sensor::LinkState state) {
    return sent_link_words("camera", state, "no $FPFRM records come over the console; send them");
  }

 private:
  const console::Counters& counters_;
  CountWatch watch_;
};
static_assert(sensor::BlobCamera<CameraOnConsole>);

class OdometryOnConsole {
 public:
  explicit OdometryOnConsole(const console::Counters& counters) : counters_(counters) {}

  base::Result<sensor::OdometrySample> poll(base::Time now) {
    watch_.watch(counters_.odometry, now);
    return base::Error::kNotReady;
  }
  [[nodiscard]] sensor::LinkState link() const { return watch_.link(); }
  [[nodiscard]] static bool stamped_here() { return false; }
  [[nodiscard]] static console::LinkWords link_words(sensor::LinkState state) {
    return sent_link_words("odometry", state, "no $FPODO records come over the console; send them");
  }

 private:
  const console::Counters& counters_;
  CountWatch watch_;
};
static_assert(sensor::OdometrySource<OdometryOnConsole>);

}  // namespace fencepost::image
