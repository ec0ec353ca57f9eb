#include "hal/mcu/stm32f4/clocks.hpp"

#include "hal/mcu/register.hpp"
#include "hal/mcu/stm32f4/registers.hpp"

namespace fencepost::mcu::stm32f4 {
namespace {

constexpr std::uint32_t kOscillatorMhz = 16;
constexpr Clocks kFromPll = {168'000'000, 42'000'000, 84'000'000, 84'000'000};
constexpr Clocks kFromOscillator = {16'000'000, 16'000'000, 16'000'000, 16'000'000};
// QEMU has no clock control; its core and lines run as if they were set up, its timers count nanoseconds.
constexpr Clocks kUnmodelled = {168'000'000, 42'000'000, 84'000'000, 1'000'000'000};

constexpr std::uint32_t kMaxPolls = 100'000;  // the PLL locks within 0.3 ms, a crystal starts within some 5

// Back to what a reset leaves: the part's own oscillator, nothing else running on anything. False if there is no clock
// control: it does not keep a bit.
bool return_to_oscillator() {
  set_bits(kRccControl, kHsiOn);
  if (!await_bits(kRccControl, kHsiOn | kHsiReady, kMaxPolls)) return false;
  clear_bits(kRccConfig, kSwitchMask);
  static_cast<void>(await_mask(kRccConfig, kSwitchedMask, 0, kMaxPolls));
  reg(kRccConfig) = 0;  // not before: the buses would run as fast as the core for a moment
  clear_bits(kRccControl, kPllOn | kAudioPllOn | kWatchHse);
  static_cast<void>(await_mask(kRccControl, kPllReady, 0, kMaxPolls));
  clear_bits(kRccControl, kHseOn);
  clear_bits(kRccControl, kHseBypass);
  reg(kRccInterrupts) = kRccForgetInterrupts;
  return true;
}

// A boot loader's USB and serial lines go silent, and the pins are inputs again.
void reset_peripherals() {
  for (const std::uint32_t resets : {kRccAhb1Reset, kRccAhb2Reset, kRccApb1Reset, kRccApb2Reset}) {
    reg(resets) = 0xFFFF'FFFF;
    reg(resets) = 0;
  }
}

// Periods of the internal oscillator that the crystal takes for 8 * 31: channel 1 of timer 11 sees the crystal divided
// by 31 (19.5.11, 7.3.3). 0 if it does not come.
std::uint32_t crystal_periods() {
  enable_clock(kRccApb2Enable, kTimer11Clock);
  reg(kTimer11 + kTimerOption) = kTimer11SeesCrystal;
  reg(kTimer11 + kTimerReload) = 0xFFFF;
  reg(kTimer11 + kTimerInputs) = kCaptureEvery8;
  reg(kTimer11 + kTimerPolarity) = kCaptureOn;
  reg(kTimer11 + kTimerControl) = kTimerEnable;
  std::uint32_t before = 0;
  std::uint32_t after = 0;
  for (int edge = 0; edge < 3; ++edge) {
    if (!await_bits(kTimer11 + kTimerStatus, kCaptured, kMaxPolls)) return 0;
    before = after;
    after = reg(kTimer11 + kTimerCapture1);  // reading it makes ready for the next
  }
  reg(kTimer11 + kTimerControl) = 0;
  return (after - before) & 0xFFFFU;
}

// MHz: that of `crystals` whose period is within a twelfth, the oscillators' tolerances and a count among that; else 0.
std::uint32_t crystal_mhz(Crystals crystals) {
  set_bits(kRccControl, kHseOn);
  if (!await_bits(kRccControl, kHseReady, kMaxPolls)) return 0;
  reg(kRccConfig) = kCrystalDividedBy31;
  const std::uint32_t periods = crystal_periods();
  for (const std::uint32_t mhz : crystals) {
    const std::uint32_t expected = mhz == 0 ? 0 : kOscillatorMhz * 31 * 8 / mhz;
    if (periods * 12 > expected * 11 && periods * 12 < expected * 13) return mhz;
  }
  clear_bits(kRccControl, kHseOn);
  return 0;
}

// 1 MHz * 336 / 2; / 7 gives the 48 MHz that USB wants (7.3.2).
bool start_pll(std::uint32_t divider, std::uint32_t source) {
  reg(kRccPll) = divider | (336U << 6) | (0U << 16) | (7U << 24) | source;
  set_bits(kRccControl, kPllOn);
  return await_bits(kRccControl, kPllReady, kMaxPolls);
}

}  // namespace

Clocks start_clocks(Crystals crystals) {
  if (!return_to_oscillator()) return kUnmodelled;
  reset_peripherals();
  enable_clock(kRccApb1Enable, kPowerClock);
  set_bits(kPowerControl, kRegulatorScale1);
  const std::uint32_t crystal = crystal_mhz(crystals);
  const bool locked = crystal != 0 ? start_pll(crystal, kPllFromCrystal) : start_pll(kOscillatorMhz, 0);
  if (!locked) return kFromOscillator;
  reg(kFlashAccess) = kFlashAt168MHz;
  static_cast<void>(await_mask(kFlashAccess, kFlashWaitMask, kFlashAt168MHz & kFlashWaitMask, kMaxPolls));
  reg(kRccConfig) = kApb1DividedBy4 | kApb2DividedBy2;
  reg(kRccConfig) = kApb1DividedBy4 | kApb2DividedBy2 | kSwitchToPll;
  // The switch waits for a PLL that is locked; it cannot fail after that.
  static_cast<void>(await_mask(kRccConfig, kSwitchedMask, kSwitchedToPll, kMaxPolls));
  return kFromPll;
}

}  // namespace fencepost::mcu::stm32f4
