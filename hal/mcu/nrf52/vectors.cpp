// The vector table (48 interrupts: the last peripheral is at 0x4002F000). The board defines the handlers named here.
#include "hal/mcu/cortex_m/vector_table.hpp"
#include "hal/mcu/nrf52/registers.hpp"

extern "C" {
[[noreturn]] void reset_handler();
void uart_interrupt();
void twi_interrupt();
void timer_interrupt();
void line_interrupt();
void edge_interrupt();
}

namespace fencepost::mcu::nrf52 {

using cortex_m::of_interrupt;
using nrf51::interrupt_of;

[[gnu::section(".vectors"), gnu::used]] extern constinit const cortex_m::VectorTable<48> vectors =
    cortex_m::make_vector_table<48>(reset_handler, {of_interrupt(interrupt_of(nrf51::kUart), uart_interrupt),
                                                    of_interrupt(interrupt_of(nrf51::kTwi0), twi_interrupt),
                                                    of_interrupt(interrupt_of(nrf51::kTimer), timer_interrupt),
                                                    of_interrupt(interrupt_of(kLine), line_interrupt),
                                                    of_interrupt(interrupt_of(kEdges), edge_interrupt)});

}  // namespace fencepost::mcu::nrf52
