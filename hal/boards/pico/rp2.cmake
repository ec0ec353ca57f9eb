# fencepost_rp2_board(<board> <part>): the object library of a board with an rp2040 or an rp2350, whose pins.hpp is beside
# its CMakeLists.txt. The program is compiled for the part, too (firmware/image).
function(fencepost_rp2_board board part)
  set(target fencepost_board_${board})
  add_library(${target} OBJECT
    ${PROJECT_SOURCE_DIR}/hal/boards/pico/board.cpp
    ${PROJECT_SOURCE_DIR}/hal/mcu/cortex_m/startup.cpp
    ${PROJECT_SOURCE_DIR}/hal/mcu/startup.cpp
    ${PROJECT_SOURCE_DIR}/hal/mcu/support.cpp
    ${PROJECT_SOURCE_DIR}/hal/mcu/rp2/clocks.cpp
    ${PROJECT_SOURCE_DIR}/hal/mcu/rp2/flash.cpp
    ${PROJECT_SOURCE_DIR}/hal/mcu/rp2/i2c.cpp
    ${PROJECT_SOURCE_DIR}/hal/mcu/rp2/loader.cpp
    ${PROJECT_SOURCE_DIR}/hal/mcu/rp2/panic.cpp
    ${PROJECT_SOURCE_DIR}/hal/mcu/rp2/timer_clock.cpp
    ${PROJECT_SOURCE_DIR}/hal/mcu/rp2/uart.cpp
    ${PROJECT_SOURCE_DIR}/hal/mcu/rp2/usb_serial.cpp
    ${PROJECT_SOURCE_DIR}/hal/mcu/rp2/vectors.cpp)
  if(part STREQUAL "rp2350")
    target_sources(${target} PRIVATE
      ${PROJECT_SOURCE_DIR}/hal/mcu/rp2350/image_def.cpp
      ${PROJECT_SOURCE_DIR}/hal/mcu/rp2/unique_id_rp2350.cpp)
    target_compile_definitions(${target} PUBLIC FENCEPOST_RP2350)
    set(kind pico2)
    set(drive RP2350)
  else()
    target_sources(${target} PRIVATE
      ${PROJECT_SOURCE_DIR}/hal/mcu/memory.cpp
      ${PROJECT_SOURCE_DIR}/hal/mcu/soft_float/aeabi.cpp
      ${PROJECT_SOURCE_DIR}/hal/mcu/soft_float/armv6m.cpp
      ${PROJECT_SOURCE_DIR}/hal/mcu/soft_float/root.cpp
      ${PROJECT_SOURCE_DIR}/hal/mcu/rp2040/boot2.cpp
      ${PROJECT_SOURCE_DIR}/hal/mcu/rp2/unique_id_rp2040.cpp)
    set(kind pico)
    set(drive RPI-RP2)
  endif()
  target_link_libraries(${target} PRIVATE fencepost_robot_flags)
  target_compile_definitions(${target} PRIVATE FENCEPOST_PINS="hal/boards/${board}/pins.hpp" FENCEPOST_BOARD_NAME=${board})
  set_target_properties(${target} PROPERTIES
    FENCEPOST_HEADER "hal/boards/pico/board.hpp"
    FENCEPOST_DEVICES all
    FENCEPOST_SCRIPT "${PROJECT_SOURCE_DIR}/hal/boards/${kind}/image.ld"
    FENCEPOST_UF2 ON)
  # How the image gets onto the board: by the drive that it shows on USB, or by a debug probe; the script looks.
  set_property(TARGET ${target} PROPERTY FENCEPOST_FLASH_TOOL cmake)
  set_property(TARGET ${target} PROPERTY FENCEPOST_FLASH_COMMAND
    ${CMAKE_COMMAND} -DIMAGE=fencepost -DDRIVE=${drive} -DPART=${part} -P ${PROJECT_SOURCE_DIR}/toolchain/cmake/flash_pico.cmake)
  set_property(TARGET ${target} PROPERTY FENCEPOST_FLASH_HINT
    "Hold BOOTSEL while you plug the board in by USB: it shows the drive ${drive}; mount it, then once more, or copy fencepost.uf2 to it by hand. The settings stay.")
endfunction()
