#include "hal/mcu/rp2/clocks.hpp"

#include "hal/mcu/register.hpp"
#include "hal/mcu/rp2/part.hpp"

namespace fencepost::mcu::rp2 {
namespace {

constexpr std::uint32_t kCrystalHz = 12'000'000;
constexpr std::uint32_t kMaxPolls = 200'000;  // the crystal takes 6 ms, a PLL some 0.1 ms
// Times 256 / 12 MHz (2.16.3): 6 ms, after which the Pico's crystal has its full swing. Less: some do not start cold.
constexpr std::uint32_t kCrystalStarts = 6 * 47;

// All of this is inlined: it runs in the flash, too, where the rest of the program is not there yet.
[[gnu::always_inline]] inline bool start_crystal() {
  reg(kXoscStartup) = kCrystalStarts;
  reg(kXoscControl) = kXoscEnable1To15MHz;
  return await_bits(kXoscStatus, kXoscStable, kMaxPolls);
}

// A debugger resets the core alone: nothing may run on a PLL that is going to be reset. The reference clock goes on,
// whatever it runs on.
[[gnu::always_inline]] inline void leave_plls() {
  reg(kClockSysResuscitate) = 0;
  lower_bits(kClockSysControl, kSysFromAuxiliary);
  static_cast<void>(await_bits(kClockSysSelected, 1U << kSysFromReference, kMaxPolls));
  reg(kClockSysControl) = 0;
  reg(kClockUsbControl) = 0;
  reg(kClockPeriControl) = 0;
  reg(kClockSysDivider) = kUndivided;
  reg(kClockUsbDivider) = kUndivided;
}

// 12 MHz * feedback / first / second; the oscillator in between within 750 and 1600 MHz (2.18.2).
[[gnu::always_inline]] inline bool start_pll(std::uint32_t pll, std::uint32_t reset, std::uint32_t feedback,
                                             std::uint32_t first, std::uint32_t second) {
  bring_up(reset);
  reg(pll + kPllControl) = 1;
  reg(pll + kPllFeedback) = feedback;
  lower_bits(pll + kPllPower, kPllDown | kPllOscillatorDown);
  if (!await_bits(pll + kPllControl, kPllLocked, kMaxPolls)) return false;
  reg(pll + kPllPostDividers) = (first << kPllFirstShift) | (second << kPllSecondShift);
  lower_bits(pll + kPllPower, kPllPostDividersDown);
  return true;
}

[[gnu::always_inline]] inline bool start_reference_clock() {
  leave_plls();
  if (!start_crystal()) return false;
  reg(kClockRefControl) = kRefFromCrystal;
  if (!await_bits(kClockRefSelected, 1U << kRefFromCrystal, kMaxPolls)) return false;
  reg(kClockRefDivider) = kUndivided;  // the ring oscillator's: of an RP2350 it may be 4
  return true;
}

// 1500 MHz in between. USB needs a core that is faster than it (erratum RP2350-E12).
[[gnu::always_inline]] inline bool start_core_clock() {
  if (!start_pll(kPllSys, kResetPllSys, 125, kPllSysFirst, 2)) return false;
  reg(kClockSysControl) = kSysFromAuxiliary;
  return await_bits(kClockSysSelected, 1U << kSysFromAuxiliary, kMaxPolls);
}

}  // namespace

Clocks start_clocks() {
  Clocks clocks{kRingHz, kRingHz, false};
  if (start_reference_clock()) {
    clocks = {kCrystalHz, kCrystalHz, false};
    if (start_core_clock()) clocks.core = kCoreHz;
    clocks.usb = clocks.core == kCoreHz && start_pll(kPllUsb, kResetPllUsb, 100, 5, 5);  // 1200 MHz
    if (clocks.usb) reg(kClockUsbControl) = kClockEnable;
  }
  reg(kClockPeriControl) = kClockEnable;
  return clocks;
}

extern "C" {
[[gnu::section(".loader"), gnu::flatten, gnu::used]] void fencepost_hurry() {
  if (start_reference_clock()) static_cast<void>(start_core_clock());
}
}

}  // namespace fencepost::mcu::rp2
