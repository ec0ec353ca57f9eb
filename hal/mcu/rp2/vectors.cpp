// The vector table. The board defines the handlers named here.
#include "hal/mcu/cortex_m/vector_table.hpp"
#include "hal/mcu/rp2/part.hpp"

extern "C" {
[[noreturn]] void load_program();
void timer_interrupt();
void usb_interrupt();
void pins_interrupt();
void uart0_interrupt();
void uart1_interrupt();
void i2c_interrupt();
}

namespace fencepost::mcu::rp2 {

using cortex_m::of_interrupt;

[[gnu::section(".vectors"), gnu::used]] extern constinit const cortex_m::VectorTable<kInterrupts> vectors =
    cortex_m::make_vector_table<kInterrupts>(
        load_program, {of_interrupt(kInterruptTimer0, timer_interrupt), of_interrupt(kInterruptUsb, usb_interrupt),
                       of_interrupt(kInterruptPins, pins_interrupt), of_interrupt(kInterruptUart0, uart0_interrupt),
                       of_interrupt(kInterruptUart1, uart1_interrupt), of_interrupt(kInterruptI2c0, i2c_interrupt),
                       of_interrupt(kInterruptI2c1, i2c_interrupt)});

}  // namespace fencepost::mcu::rp2
