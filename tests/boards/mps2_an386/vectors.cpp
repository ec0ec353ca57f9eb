#include "hal/mcu/cortex_m/vector_table.hpp"
#include "tests/boards/mps2_an386/line.hpp"

extern "C" {
[[noreturn]] void reset_handler();
void systick_interrupt();
void uart_interrupt();
void line_interrupt();
}

namespace fencepost::test::mps2 {

using mcu::cortex_m::of_interrupt;

[[gnu::section(".vectors"), gnu::used]] extern constinit const mcu::cortex_m::VectorTable<32> vectors =
    mcu::cortex_m::make_vector_table<32>(reset_handler,
                                         {{mcu::cortex_m::kSysTick, systick_interrupt},
                                          of_interrupt(kInterruptReceived, uart_interrupt),
                                          of_interrupt(kInterruptReceived + kSentAfterReceived, uart_interrupt),
                                          of_interrupt(interrupt_of_uart(1), line_interrupt),
                                          of_interrupt(interrupt_of_uart(1) + kSentAfterReceived, line_interrupt)});

}  // namespace fencepost::test::mps2
