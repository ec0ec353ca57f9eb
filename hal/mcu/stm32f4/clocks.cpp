#include "hal/mcu/stm32f4/clocks.hpp"

#include "hal/mcu/register.hpp"
#include "hal/mcu/stm32f4/registers.hpp"

namespace fencepost::mcu::stm32f4 {
namespace {

constexpr Clocks kFromPll = {168'000'000, 42'000'000, 84'000'000};
constexpr Clocks kFromOscillator = {16'000'000, 16'000'000, 16'000'000};

// 16 MHz / 16 * 336 / 2; / 7 gives the 48 MHz that USB wants (7.3.2). Bit 22 clear: from the internal oscillator.
constexpr std::uint32_t kPllSetting = 16U | (336U << 6) | (0U << 16) | (7U << 24);
constexpr std::uint32_t kMaxPolls = 100'000;  // the PLL locks within 0.3 ms (datasheet, PLL characteristics)

}  // namespace

Clocks start_clocks() {
  // The internal oscillator runs from reset; where it does not, this is an emulator without a clock tree, whose core
  // runs as if it were set up.
  const bool modelled = (reg(kRccControl) & kHsiOn) != 0;
  set_bits(kRccApb1Enable, kPowerClock);
  set_bits(kPowerControl, kRegulatorScale1);
  reg(kRccPll) = kPllSetting;
  set_bits(kRccControl, kPllOn);
  if (!modelled) return kFromPll;
  if (!await_bits(kRccControl, kPllReady, kMaxPolls)) return kFromOscillator;
  reg(kFlashAccess) = kFlashAt168MHz;
  set_bits(kRccConfig, kApb1DividedBy4 | kApb2DividedBy2);
  change_bits(kRccConfig, kSwitchMask, kSwitchToPll);
  // The switch waits for a PLL that is locked; it cannot fail after that.
  static_cast<void>(await_bits(kRccConfig, kSwitchedToPll, kMaxPolls));
  return kFromPll;
}

}  // namespace fencepost::mcu::stm32f4
