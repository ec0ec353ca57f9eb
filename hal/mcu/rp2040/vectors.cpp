// The vector table (RP2040 datasheet 2.3.2). The board defines the handlers named here.
#include "hal/mcu/cortex_m/vector_table.hpp"
#include "hal/mcu/rp2040/registers.hpp"

extern "C" {
[[noreturn]] void load_program();
void timer_interrupt();
void usb_interrupt();
void pins_interrupt();
void uart0_interrupt();
void uart1_interrupt();
void i2c_interrupt();
}

namespace fencepost::mcu::rp2040 {

using cortex_m::of_interrupt;

[[gnu::section(".vectors"), gnu::used]] extern constinit const cortex_m::VectorTable<26> vectors =
    cortex_m::make_vector_table<26>(
        load_program, {of_interrupt(kInterruptTimer0, timer_interrupt), of_interrupt(kInterruptUsb, usb_interrupt),
                       of_interrupt(kInterruptPins, pins_interrupt), of_interrupt(kInterruptUart0, uart0_interrupt),
                       of_interrupt(kInterruptUart1, uart1_interrupt), of_interrupt(kInterruptI2c0, i2c_interrupt),
                       of_interrupt(kInterruptI2c1, i2c_interrupt)});

}  // namespace fencepost::mcu::rp2040
