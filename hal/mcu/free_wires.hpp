// Releases an I2C bus whose data wire is held low.
#pragma once

namespace fencepost::mcu {

/// A device interrupted within a byte holds the data wire until it has received the remaining clocks, at most nine;
/// then a stop condition. `Wire`: one of the two, driven by hand: `pull_down(bool)`, `high()`. `pause()`: half a period
/// of the bus.
template <class Wire, class Pause>
void free_wires(const Wire& clock, const Wire& data, Pause pause) {
  clock.pull_down(false);
  data.pull_down(false);
  pause();
  for (int i = 0; i < 9 && !data.high(); ++i) {
    clock.pull_down(true);
    pause();
    clock.pull_down(false);
    pause();
  }
  data.pull_down(true);
  pause();
  data.pull_down(false);
  pause();
}

}  // namespace fencepost::mcu
