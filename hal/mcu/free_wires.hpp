// What a master does on a two-wire bus whose data wire is held.
#pragma once

namespace fencepost::mcu {

/// A device that was cut off in a byte holds the data wire until it has got its clocks: nine at most; then a stop.
/// `Wire`: one of the two by hand, as others have it, too: `pull_down(bool)`, `high()`. `pause()`: half a period of the
/// bus.
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
