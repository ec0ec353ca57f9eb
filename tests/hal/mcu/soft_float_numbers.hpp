// Test values for float arithmetic, on the desk and on a board without a library.
#pragma once

#include "hal/mcu/soft_float/float32.hpp"

namespace fencepost::test {

/// Numbers near each other, of all sizes, with few bits set, at the ends of the range, infinities and NaNs.
/// `Random`: each call gives 32 random bits.
template <class Random>
class Numbers {
 public:
  using Bits = mcu::soft::Bits;

  explicit Numbers(Random random) : random_(random) {}

  Bits next() {
    const auto x = static_cast<Bits>(random_());
    const auto e = static_cast<Bits>(random_());
    switch (random_() % 8) {
      case 0: return x;
      case 1: return with_exponent(x, 107 + e % 40);
      case 2: return with_exponent(x & 0x8000'0007U, e % 256);
      case 3: return with_exponent(x, e % 2);
      case 4: return with_exponent(x, 254 - e % 3);
      case 5: return with_exponent(x, 124 + e % 6);
      case 6: return with_exponent(x & 0x807F'F000U, 120 + e % 16);
      default: return last_ = last_ ^ (x & 0x8000'000FU);
    }
  }

 private:
  static Bits with_exponent(Bits x, Bits exponent) { return (x & 0x807F'FFFFU) | (exponent << 23); }

  Random random_;
  Bits last_ = 0x3F80'0000;
};

}  // namespace fencepost::test
