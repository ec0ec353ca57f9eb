// Raspberry Pi Pico. Sources: its datasheet, chapter 2.1 (pinout); functions by the RP2040 datasheet, 2.19.2.
#pragma once

#include "hal/boards/pico/wiring.hpp"
#include "hal/mcu/rp2/part.hpp"

namespace fencepost::board::pico {

namespace part = mcu::rp2;

inline constexpr Wiring kWiring = {
    .target = "pico",
    .console = part::UartWiring{part::kUart0, part::kResetUart0, part::kInterruptUart0, {0}, {1}},
    .camera = {part::kUart1, part::kResetUart1, part::kInterruptUart1, {4}, {5}},
    .i2c = {part::kI2c0, part::kResetI2c0, part::kInterruptI2c0, {8}, {9}},
    .left = {{10}, {11}},
    .right = {{12}, {13}},
    .light = part::Pin{25},
    .button = {22},
    .stop = {15},
    .left_motor = {.power = {16}, .direction = std::nullopt},  // an H-bridge beside the board
    .right_motor = {.power = {17}, .direction = std::nullopt},
    .names = {"GP4 sends, GP5 receives", "GP4 sends, GP5 receives", "GP8 data, GP9 clock", "GP10 and 11, GP12 and 13"},
};

}  // namespace fencepost::board::pico
