// sqrtf of the C library, by the same arithmetic.
#include "hal/mcu/soft_float/float32.hpp"

namespace soft = fencepost::mcu::soft;

// Its name in the library; declared by that, it could not take bits.
extern "C" soft::Bits fencepost_root(soft::Bits x) asm("sqrtf");
soft::Bits fencepost_root(soft::Bits x) { return soft::root(x); }
