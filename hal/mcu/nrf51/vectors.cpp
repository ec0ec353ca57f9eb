// The vector table (chapter 4.2: 32 interrupts). The board defines the handlers named here.
#include "hal/mcu/cortex_m/vector_table.hpp"
#include "hal/mcu/nrf51/registers.hpp"

extern "C" {
[[noreturn]] void reset_handler();
void uart_interrupt();
void twi_interrupt();
void timer_interrupt();
}

namespace fencepost::mcu::nrf51 {

using cortex_m::of_interrupt;

[[gnu::section(".vectors"), gnu::used]] extern constinit const cortex_m::VectorTable<32> vectors =
    cortex_m::make_vector_table<32>(reset_handler, {of_interrupt(interrupt_of(kUart), uart_interrupt),
                                                    of_interrupt(interrupt_of(kTwi0), twi_interrupt),
                                                    of_interrupt(interrupt_of(kTimer), timer_interrupt)});

}  // namespace fencepost::mcu::nrf51
