#include "hal/mcu/rp2040/clocks.hpp"

#include "hal/mcu/register.hpp"
#include "hal/mcu/rp2040/registers.hpp"

namespace fencepost::mcu::rp2040 {
namespace {

constexpr std::uint32_t kCrystalHz = 12'000'000;
constexpr std::uint32_t kRingHz = 6'500'000;
constexpr std::uint32_t kMaxPolls = 200'000;  // the crystal takes 1 ms, a PLL some 0.1 ms

bool start_crystal() {
  reg(kXoscStartup) = 47;  // * 256 / 12 MHz: 1 ms (2.16.3)
  reg(kXoscControl) = kXoscEnable1To15MHz;
  return await_bits(kXoscStatus, kXoscStable, kMaxPolls);
}

// 12 MHz * feedback / first / second; the oscillator in between within 750 and 1600 MHz (2.18.2).
bool start_pll(std::uint32_t pll, std::uint32_t reset, std::uint32_t feedback, std::uint32_t first,
               std::uint32_t second) {
  bring_up(reset);
  reg(pll + kPllControl) = 1;
  reg(pll + kPllFeedback) = feedback;
  lower_bits(pll + kPllPower, kPllDown | kPllOscillatorDown);
  if (!await_bits(pll + kPllControl, kPllLocked, kMaxPolls)) return false;
  reg(pll + kPllPostDividers) = (first << kPllFirstShift) | (second << kPllSecondShift);
  lower_bits(pll + kPllPower, kPllPostDividersDown);
  return true;
}

}  // namespace

Clocks start_clocks() {
  Clocks clocks{kRingHz, kRingHz, false};
  if (start_crystal()) {
    reg(kClockRefControl) = kRefFromCrystal;
    static_cast<void>(await_bits(kClockRefSelected, 1U << kRefFromCrystal, kMaxPolls));
    clocks = {kCrystalHz, kCrystalHz, false};
    if (start_pll(kPllSys, kResetPllSys, 125, 6, 2)) {  // 1500 MHz
      reg(kClockSysControl) = kSysFromAuxiliary;
      static_cast<void>(await_bits(kClockSysSelected, 1U << kSysFromAuxiliary, kMaxPolls));
      clocks.core = 125'000'000;
    }
    clocks.usb = start_pll(kPllUsb, kResetPllUsb, 100, 5, 5);  // 1200 MHz
    if (clocks.usb) reg(kClockUsbControl) = kClockEnable;
  }
  reg(kClockPeriControl) = kClockEnable;
  return clocks;
}

}  // namespace fencepost::mcu::rp2040
