// A push button, whose contact bounces.
#pragma once

#include "hal/base/stamp.hpp"
#include "hal/base/units.hpp"

namespace fencepost::loop {

class Button {
 public:
  /// Several times in kSteady. True: it is pressed, once each time. A button that is held down from the beginning
  /// counts when it is pressed again.
  [[nodiscard]] bool pressed(bool held, base::Time now) {
    if (held != last_) since_ = base::Stamp(now);
    last_ = held;
    if (held == held_ || since_.since(now) < kSteady) return false;
    held_ = held;
    return held;
  }

 private:
  /// Contacts of small buttons bounce for some 5 ms; pulses of a motor's wires beside them are shorter still.
  static constexpr base::Duration kSteady = base::milliseconds(20);

  bool last_ = true;
  bool held_ = true;  ///< once the bouncing is over
  base::Stamp since_;
};

}  // namespace fencepost::loop
