// Float arithmetic by the compiler's names, in place of its own library (Run-time ABI for the Arm Architecture, 4.1.2).
// Sums, products and order are in armv6m.cpp. Floats come and go in the same registers as integers do here.
#include <cstdint>

#include "hal/mcu/soft_float/float32.hpp"

namespace soft = fencepost::mcu::soft;
using soft::Bits;

extern "C" {
Bits __aeabi_fadd(Bits a, Bits b);
Bits __aeabi_frsub(Bits a, Bits b);
Bits __aeabi_fdiv(Bits a, Bits b);
int __aeabi_fcmpeq(Bits a, Bits b);
int __aeabi_fcmpun(Bits a, Bits b);
Bits __aeabi_i2f(std::int32_t value);
Bits __aeabi_ui2f(std::uint32_t value);
Bits __aeabi_l2f(std::int64_t value);
Bits __aeabi_ul2f(std::uint64_t value);
std::int32_t __aeabi_f2iz(Bits x);
std::uint32_t __aeabi_f2uiz(Bits x);
std::int64_t __aeabi_f2lz(Bits x);
std::uint64_t __aeabi_f2ulz(Bits x);

Bits __aeabi_frsub(Bits a, Bits b) { return __aeabi_fadd(b, a ^ soft::kSign); }
Bits __aeabi_fdiv(Bits a, Bits b) { return soft::divide(a, b); }

int __aeabi_fcmpeq(Bits a, Bits b) { return soft::equal(a, b) ? 1 : 0; }
int __aeabi_fcmpun(Bits a, Bits b) { return soft::unordered(a, b) ? 1 : 0; }

Bits __aeabi_i2f(std::int32_t value) { return soft::from_signed(value); }
Bits __aeabi_ui2f(std::uint32_t value) { return soft::from_unsigned(value); }
Bits __aeabi_l2f(std::int64_t value) { return soft::from_signed64(value); }
Bits __aeabi_ul2f(std::uint64_t value) { return soft::from_unsigned64(value); }
std::int32_t __aeabi_f2iz(Bits x) {
  const auto amount = static_cast<std::int32_t>(soft::amount(x));
  return (x & soft::kSign) != 0 ? -amount : amount;
}
std::uint32_t __aeabi_f2uiz(Bits x) { return (x & soft::kSign) != 0 ? 0 : soft::amount(x); }
std::int64_t __aeabi_f2lz(Bits x) {
  const auto amount = static_cast<std::int64_t>(soft::amount64(x));
  return (x & soft::kSign) != 0 ? -amount : amount;
}
std::uint64_t __aeabi_f2ulz(Bits x) { return (x & soft::kSign) != 0 ? 0 : soft::amount64(x); }
}
