// The compiler's names for division (Run-time ABI for the Arm Architecture, 4.2 and 4.3.1), in place of its own
// library.
#include <cstdint>

#include "hal/mcu/division/division.hpp"

using fencepost::mcu::division::divide;
using fencepost::mcu::division::Divided;

namespace {

/// Quotient and remainder in the registers of one long number.
template <class Int>
std::uint64_t in_registers(const Divided<Int>& parts) {
  return static_cast<std::uint32_t>(parts.quotient) |
         static_cast<std::uint64_t>(static_cast<std::uint32_t>(parts.remainder)) << 32U;
}

}  // namespace

extern "C" {
std::uint64_t __aeabi_uidivmod(std::uint32_t n, std::uint32_t d);
std::uint32_t __aeabi_uidiv(std::uint32_t n, std::uint32_t d);
std::uint64_t __aeabi_idivmod(std::int32_t n, std::int32_t d);
std::int32_t __aeabi_idiv(std::int32_t n, std::int32_t d);
void fencepost_uldivmod(std::uint64_t n, std::uint64_t d, Divided<std::uint64_t>* out);
void fencepost_ldivmod(std::int64_t n, std::int64_t d, Divided<std::int64_t>* out);
void __aeabi_uldivmod();
void __aeabi_ldivmod();

[[gnu::noinline]] std::uint64_t __aeabi_uidivmod(std::uint32_t n, std::uint32_t d) {
  return in_registers(divide(n, d));
}
[[gnu::noinline]] std::uint64_t __aeabi_idivmod(std::int32_t n, std::int32_t d) { return in_registers(divide(n, d)); }
// The quotient is where the pair has it.
std::uint32_t __aeabi_uidiv(std::uint32_t n, std::uint32_t d) {
  return static_cast<std::uint32_t>(__aeabi_uidivmod(n, d));
}
std::int32_t __aeabi_idiv(std::int32_t n, std::int32_t d) { return static_cast<std::int32_t>(__aeabi_idivmod(n, d)); }

[[gnu::used]] void fencepost_uldivmod(std::uint64_t n, std::uint64_t d, Divided<std::uint64_t>* out) {
  *out = divide(n, d);
}
[[gnu::used]] void fencepost_ldivmod(std::int64_t n, std::int64_t d, Divided<std::int64_t>* out) {
  *out = divide(n, d);
}

// Four registers are no result that C++ could give. 32 bytes of stack, which tests/boards/image_check.py knows.
// clang-format off
#define FENCEPOST_LONG_DIVISION(callee)                                                                  \
  asm volatile("push {r4, lr}\n sub sp, #24\n add r4, sp, #8\n str r4, [sp]\n bl " callee                \
               "\n ldmia r4!, {r0, r1, r2, r3}\n add sp, #24\n pop {r4, pc}")
[[gnu::naked]] void __aeabi_uldivmod() { FENCEPOST_LONG_DIVISION("fencepost_uldivmod"); }
[[gnu::naked]] void __aeabi_ldivmod() { FENCEPOST_LONG_DIVISION("fencepost_ldivmod"); }
#undef FENCEPOST_LONG_DIVISION
// clang-format on
}
