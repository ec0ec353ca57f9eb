# fencepost_rp2040_board(<board>): the object library of a board with this part, whose pins.hpp is beside its CMakeLists.txt.
function(fencepost_rp2040_board board)
  set(target fencepost_board_${board})
  add_library(${target} OBJECT
    ${PROJECT_SOURCE_DIR}/hal/boards/pico/board.cpp
    ${PROJECT_SOURCE_DIR}/hal/mcu/cortex_m/startup.cpp
    ${PROJECT_SOURCE_DIR}/hal/mcu/memory.cpp
    ${PROJECT_SOURCE_DIR}/hal/mcu/soft_float/aeabi.cpp
    ${PROJECT_SOURCE_DIR}/hal/mcu/soft_float/armv6m.cpp
    ${PROJECT_SOURCE_DIR}/hal/mcu/soft_float/root.cpp
    ${PROJECT_SOURCE_DIR}/hal/mcu/startup.cpp
    ${PROJECT_SOURCE_DIR}/hal/mcu/support.cpp
    ${PROJECT_SOURCE_DIR}/hal/mcu/rp2040/boot2.cpp
    ${PROJECT_SOURCE_DIR}/hal/mcu/rp2040/clocks.cpp
    ${PROJECT_SOURCE_DIR}/hal/mcu/rp2040/flash.cpp
    ${PROJECT_SOURCE_DIR}/hal/mcu/rp2040/i2c.cpp
    ${PROJECT_SOURCE_DIR}/hal/mcu/rp2040/loader.cpp
    ${PROJECT_SOURCE_DIR}/hal/mcu/rp2040/panic.cpp
    ${PROJECT_SOURCE_DIR}/hal/mcu/rp2040/timer_clock.cpp
    ${PROJECT_SOURCE_DIR}/hal/mcu/rp2040/uart.cpp
    ${PROJECT_SOURCE_DIR}/hal/mcu/rp2040/usb_serial.cpp
    ${PROJECT_SOURCE_DIR}/hal/mcu/rp2040/vectors.cpp)
  target_link_libraries(${target} PRIVATE fencepost_robot_flags)
  target_compile_definitions(${target} PRIVATE FENCEPOST_PINS="hal/boards/${board}/pins.hpp" FENCEPOST_BOARD_NAME=${board})
  set_target_properties(${target} PROPERTIES
    FENCEPOST_HEADER "hal/boards/pico/board.hpp"
    FENCEPOST_DEVICES all
    FENCEPOST_SCRIPT "${PROJECT_SOURCE_DIR}/hal/boards/pico/image.ld"
    FENCEPOST_UF2 ON)
  # How the image gets onto the board: by the drive that it shows on USB, or by a debug probe; the script looks.
  set_property(TARGET ${target} PROPERTY FENCEPOST_FLASH_TOOL cmake)
  set_property(TARGET ${target} PROPERTY FENCEPOST_FLASH_COMMAND
    ${CMAKE_COMMAND} -DIMAGE=fencepost -P ${PROJECT_SOURCE_DIR}/toolchain/cmake/flash_pico.cmake)
  set_property(TARGET ${target} PROPERTY FENCEPOST_FLASH_HINT
    "Hold BOOTSEL while you plug the Pico in by USB: it shows the drive RPI-RP2; mount it, then once more, or copy fencepost.uf2 to it by hand. The settings stay.")
endfunction()
