// When a change of a cable's state is reported. Times are the robot's clock, not the stream's: a replay has no cables.
#pragma once

#include <cstdint>
#include <optional>

#include "hal/base/units.hpp"
#include "hal/sensor/link_state.hpp"

namespace fencepost::loop {

/// Absent and ok are reported at once. Other states are reported once they have lasted a second, for a device that
/// starts, or a blob that flickers, goes through several. Three bytes, because the smallest memory holds one for each
/// sensor.
class LinkWatch {
 public:
  /// The state to report now. It stays due until sent().
  std::optional<sensor::LinkState> observe(sensor::LinkState state, base::Time now) {
    if (seen_ != byte(state)) {
      seen_ = byte(state);
      since_ = tenths(now);
    }
    if (sent_ == seen_) return std::nullopt;
    const bool at_once = state == sensor::LinkState::kAbsent || state == sensor::LinkState::kOk;
    // The counter wraps after 25.6 s: a line that found no room until then waits once more.
    const auto lasted = static_cast<std::uint8_t>(tenths(now) - since_);
    if (!at_once && lasted <= kLasting) return std::nullopt;
    return state;
  }
  void sent() { sent_ = seen_; }
  /// The state in force is due again, for a new reader.
  void resend() { sent_ = kNothing; }

  [[nodiscard]] std::optional<sensor::LinkState> last_sent() const {
    if (sent_ == kNothing) return std::nullopt;
    return static_cast<sensor::LinkState>(sent_);
  }

 private:
  static constexpr std::uint8_t kNothing = 0xFF;
  static constexpr std::uint8_t kLasting = 10;  ///< tenths of a second, of which the first may be nearly over

  static constexpr std::uint8_t byte(sensor::LinkState state) { return static_cast<std::uint8_t>(state); }
  static constexpr std::uint8_t tenths(base::Time now) { return static_cast<std::uint8_t>(now.raw / 1000); }

  std::uint8_t sent_ = kNothing;
  std::uint8_t seen_ = kNothing;
  std::uint8_t since_ = 0;  ///< tenths of a second, modulo 256
};

/// Of camera and odometry.
struct LinkWatches {
  LinkWatch camera;
  LinkWatch odometry;
};

}  // namespace fencepost::loop
