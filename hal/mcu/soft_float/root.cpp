// sqrtf of the C library, by the same arithmetic.
#include <bit>

#include "hal/mcu/soft_float/float32.hpp"

extern "C" float sqrtf(float x);
float sqrtf(float x) {
  return std::bit_cast<float>(fencepost::mcu::soft::root(std::bit_cast<fencepost::mcu::soft::Bits>(x)));
}
