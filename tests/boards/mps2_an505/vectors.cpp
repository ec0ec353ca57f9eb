#include "hal/mcu/cortex_m/vector_table.hpp"
#include "tests/boards/mps2_an386/line.hpp"

extern "C" {
[[noreturn]] void reset_handler();
void systick_interrupt();
void uart0_interrupt();
void uart1_interrupt();
}

namespace fencepost::test::mps2 {

using mcu::cortex_m::of_interrupt;

[[gnu::section(".vectors"), gnu::used]] extern constinit const mcu::cortex_m::VectorTable<64> vectors =
    mcu::cortex_m::make_vector_table<64>(reset_handler,
                                         {{mcu::cortex_m::kSysTick, systick_interrupt},
                                          of_interrupt(interrupt_of_uart(0), uart0_interrupt),
                                          of_interrupt(interrupt_of_uart(0) + kSentAfterReceived, uart0_interrupt),
                                          of_interrupt(interrupt_of_uart(1), uart1_interrupt),
                                          of_interrupt(interrupt_of_uart(1) + kSentAfterReceived, uart1_interrupt)});

}  // namespace fencepost::test::mps2
