// The vector table (RM0090 table 61). The board defines the handlers named here.
#include "hal/mcu/cortex_m/vector_table.hpp"
#include "hal/mcu/stm32f4/registers.hpp"

extern "C" {
[[noreturn]] void reset_handler();
void systick_interrupt();
void i2c1_event_interrupt();
void i2c1_error_interrupt();
void usart1_interrupt();
void usart2_interrupt();
void usart3_interrupt();
void uart4_interrupt();
void usart6_interrupt();
}

namespace fencepost::mcu::stm32f4 {

using cortex_m::of_interrupt;

[[gnu::section(".vectors"), gnu::used]] extern constinit const cortex_m::VectorTable<82> vectors =
    cortex_m::make_vector_table<82>(reset_handler, {{cortex_m::kSysTick, systick_interrupt},
                                                    of_interrupt(kInterruptI2c1Event, i2c1_event_interrupt),
                                                    of_interrupt(kInterruptI2c1Error, i2c1_error_interrupt),
                                                    of_interrupt(kInterruptUsart1, usart1_interrupt),
                                                    of_interrupt(kInterruptUsart2, usart2_interrupt),
                                                    of_interrupt(kInterruptUsart3, usart3_interrupt),
                                                    of_interrupt(kInterruptUart4, uart4_interrupt),
                                                    of_interrupt(kInterruptUsart6, usart6_interrupt)});

}  // namespace fencepost::mcu::stm32f4
