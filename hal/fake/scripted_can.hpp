// A CAN bus that plays a script by the test's clock.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "hal/base/result.hpp"
#include "hal/base/units.hpp"
#include "hal/bus/can_bus.hpp"
#include "hal/fake/stepped_clock.hpp"

namespace fencepost::fake {

/// A frame, or one failed receive, that is there from `at` on.
struct CanStep {
  base::Time at;
  bus::CanFrame frame;
  std::optional<base::Error> error;
};

/// After the script: kNotReady.
class ScriptedCan {
 public:
  /// The script, its times not decreasing, and the clock are borrowed.
  constexpr ScriptedCan(std::span<const CanStep> script, const SteppedClock& clock) : script_(script), clock_(clock) {}

  constexpr base::Result<bus::CanFrame> receive() {
    if (gone_) return base::Error::kGone;
    if (next_ == script_.size() || clock_.now() < script_[next_].at) return base::Error::kNotReady;
    const CanStep& step = script_[next_++];
    if (step.error) return *step.error;
    return step.frame;
  }

  constexpr void unplug() { gone_ = true; }
  constexpr void replug() { gone_ = false; }
  [[nodiscard]] constexpr bool finished() const { return next_ == script_.size(); }

 private:
  std::span<const CanStep> script_;
  const SteppedClock& clock_;
  std::size_t next_ = 0;
  bool gone_ = false;
};

static_assert(bus::CanBus<ScriptedCan>);

}  // namespace fencepost::fake
