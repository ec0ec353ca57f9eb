// Around commands to the flash: reading by address ends, and begins again.
#pragma once

#include "hal/mcu/cortex_m/core.hpp"
#include "hal/mcu/rp2/part.hpp"

namespace fencepost::mcu::rp2 {

/// By functions of the boot ROM (RP2040 datasheet 2.8.3.1.3). They end with reading by 03h as after boot2, but slower:
/// an RP2040's ROM leaves a divider of 6 where boot2 has 4.
class FlashAccess {
 public:
  /// The ROM has all of them.
  [[nodiscard]] bool whole() const {
    return connect_ != nullptr && leave_reading_ != nullptr && forget_cache_ != nullptr && read_again_ != nullptr;
  }
  /// `work` and its caller have to run from memory. Interrupts are held meanwhile.
  template <class Work>
  void with(Work&& work) const {
    const cortex_m::InterruptsHeld held;
    connect_();
    leave_reading_();
    work();
    forget_cache_();
    read_again_();
  }

 private:
  using Step = void();

  Step* connect_ = rom_function<Step>(rom_code('I', 'F'));
  Step* leave_reading_ = rom_function<Step>(rom_code('E', 'X'));
  Step* forget_cache_ = rom_function<Step>(rom_code('F', 'C'));
  Step* read_again_ = rom_function<Step>(rom_code('C', 'X'));
};

}  // namespace fencepost::mcu::rp2
