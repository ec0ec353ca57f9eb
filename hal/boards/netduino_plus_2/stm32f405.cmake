# fencepost_stm32f405_board(<board> <hint>): the object library of a board with this part, whose pins.hpp is beside its
# CMakeLists.txt. `hint`: how it is made to wait for a program.
function(fencepost_stm32f405_board board hint)
  set(target fencepost_board_${board})
  add_library(${target} OBJECT
    ${PROJECT_SOURCE_DIR}/hal/boards/netduino_plus_2/board.cpp
    ${PROJECT_SOURCE_DIR}/hal/mcu/cortex_m/panic.cpp
    ${PROJECT_SOURCE_DIR}/hal/mcu/cortex_m/startup.cpp
    ${PROJECT_SOURCE_DIR}/hal/mcu/startup.cpp
    ${PROJECT_SOURCE_DIR}/hal/mcu/support.cpp
    ${PROJECT_SOURCE_DIR}/hal/mcu/stm32f4/clocks.cpp
    ${PROJECT_SOURCE_DIR}/hal/mcu/stm32f4/flash.cpp
    ${PROJECT_SOURCE_DIR}/hal/mcu/stm32f4/i2c.cpp
    ${PROJECT_SOURCE_DIR}/hal/mcu/stm32f4/timer_clock.cpp
    ${PROJECT_SOURCE_DIR}/hal/mcu/stm32f4/uart.cpp
    ${PROJECT_SOURCE_DIR}/hal/mcu/stm32f4/vectors.cpp)
  target_link_libraries(${target} PRIVATE fencepost_robot_flags)
  target_compile_definitions(${target} PRIVATE FENCEPOST_PINS="hal/boards/${board}/pins.hpp" FENCEPOST_BOARD_NAME=${board})
  set_target_properties(${target} PROPERTIES
    FENCEPOST_HEADER "hal/boards/netduino_plus_2/board.hpp"
    FENCEPOST_DEVICES all
    FENCEPOST_SCRIPT "${PROJECT_SOURCE_DIR}/hal/boards/netduino_plus_2/image.ld"
    FENCEPOST_FLASH_TOOL dfu-util
    FENCEPOST_FLASH_COMMAND "dfu-util;-d;0483:df11;-a0;-s;0x08000000:leave;-D;fencepost.bin"
    FENCEPOST_FLASH_HINT "${hint} Then once more. Afterwards undo that and press reset, or the board waits again. By a debug probe: openocd -f interface/stlink.cfg -f target/stm32f4x.cfg -c 'program fencepost.elf verify reset exit' (keeps the settings, dfu-util does not).")
endfunction()
