// A program for the emulated micro:bit: what the boards' assembly (hal/mcu/soft_float/armv6m.cpp) makes of two floats,
// beside hal/mcu/soft_float/float32.hpp, which tests/hal/mcu compares with the desk's. Its end is the emulator's exit
// status: 0, or 1 and a line with what differed.
#include <array>
#include <cstdint>

#include "hal/mcu/soft_float/float32.hpp"
#include "tests/hal/mcu/soft_float_numbers.hpp"

using fencepost::mcu::soft::Bits;
namespace soft = fencepost::mcu::soft;

extern "C" {
Bits __aeabi_fadd(Bits a, Bits b);
Bits __aeabi_fsub(Bits a, Bits b);
Bits __aeabi_fmul(Bits a, Bits b);
Bits __aeabi_fdiv(Bits a, Bits b);
Bits __aeabi_fcmplt(Bits a, Bits b);
Bits __aeabi_fcmple(Bits a, Bits b);
Bits __aeabi_fcmpge(Bits a, Bits b);
Bits __aeabi_fcmpgt(Bits a, Bits b);
void start();
extern char image_stack_top;
}

namespace {

constexpr int kWriteText = 0x04;  // operations of semihosting (Arm's specification, 7)
constexpr int kExit = 0x18;
constexpr std::uint32_t kApplicationExit = 0x20026;  // arguments of kExit
constexpr std::uint32_t kRunTimeError = 0x20023;

void ask_host(int operation, std::uint32_t argument) {
  register int r0 asm("r0") = operation;
  register std::uint32_t r1 asm("r1") = argument;
  asm volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
}

// Marsaglia's.
class Xorshift {
 public:
  std::uint32_t operator()() {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 17;
    state_ ^= state_ << 5;
    return state_;
  }

 private:
  std::uint32_t state_ = 20'011;
};

struct Operation {
  char sign;
  Bits (*on_board)(Bits, Bits);
  Bits (*expected)(Bits, Bits);
};
Bits less(Bits a, Bits b) { return soft::less(a, b) ? 1 : 0; }
Bits at_most(Bits a, Bits b) { return soft::less_or_equal(a, b) ? 1 : 0; }
Bits at_least(Bits a, Bits b) { return at_most(b, a); }
Bits more(Bits a, Bits b) { return less(b, a); }
constexpr std::array<Operation, 8> kOperations = {{{'+', __aeabi_fadd, soft::add},
                                                   {'-', __aeabi_fsub, soft::subtract},
                                                   {'*', __aeabi_fmul, soft::multiply},
                                                   {'/', __aeabi_fdiv, soft::divide},
                                                   {'<', __aeabi_fcmplt, less},
                                                   {'[', __aeabi_fcmple, at_most},
                                                   {']', __aeabi_fcmpge, at_least},
                                                   {'>', __aeabi_fcmpgt, more}}};

void tell(char sign, Bits a, Bits b, Bits got) {
  std::array<char, 32> text{};
  char* at = text.data();
  const auto hex = [&](Bits bits) {
    for (int shift = 28; shift >= 0; shift -= 4) *at++ = "0123456789abcdef"[(bits >> shift) & 15];
  };
  hex(a);
  *at++ = sign;
  hex(b);
  *at++ = '=';
  hex(got);
  *at = '\n';
  ask_host(kWriteText, reinterpret_cast<std::uintptr_t>(text.data()));
}

bool same(Bits a, Bits b) { return a == b || (soft::is_nan(a) && soft::is_nan(b)); }

bool all_agree(int rounds) {
  fencepost::test::Numbers numbers(Xorshift{});
  for (int i = 0; i < rounds; ++i) {
    const Bits a = numbers.next();
    const Bits b = numbers.next();
    for (const Operation& operation : kOperations) {
      const Bits got = operation.on_board(a, b);
      if (same(got, operation.expected(a, b))) continue;
      tell(operation.sign, a, b, got);
      return false;
    }
  }
  return true;
}

}  // namespace

void start() {
  constexpr int kRounds = 4'000'000;
  ask_host(kExit, all_agree(kRounds) ? kApplicationExit : kRunTimeError);
  for (;;) {
  }
}

// The first words of the image, for the core: its stack, where to go.
struct Vectors {
  char* stack;
  void (*reset)();
};
[[gnu::section(".vectors"), gnu::used]] const Vectors kVectors = {&image_stack_top, start};
