// There is none: a loop sees at its next deadline what was raised.
#include "hal/linux/signal_flag.hpp"

namespace fencepost::linux {

Opened<SignalFlag> SignalFlag::open() { return Problem{"there is no flag that wakes a loop on this system"}; }

void SignalFlag::raise() {}
void SignalFlag::clear() {}

}  // namespace fencepost::linux
