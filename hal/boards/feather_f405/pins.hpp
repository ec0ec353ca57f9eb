// Feather STM32F405 Express: a crystal of 12 MHz. Sources: MicroPython's board definition ADAFRUIT_F405_EXPRESS,
// alternate functions by table 9 of the datasheet. The header's names are behind each pin.
#pragma once

#include "hal/boards/netduino_plus_2/wiring.hpp"

namespace fencepost::board::feather_f405 {

namespace part = mcu::stm32f4;

inline constexpr Wiring kWiring = {
    .target = "feather_f405",
    .crystals = {12},
    .console = {part::kUsart3Part, {'B', 10}, {'B', 11}},              // TX, RX
    .camera = {part::kUsart6Part, {'C', 6}, {'C', 7}},                 // D6, D5
    .base = {part::kUsart1Part, {'B', 6}, {'B', 7}},                   // SCL, SDA
    .i2c_clock = {'B', 8},                                             // D9
    .i2c_data = {'B', 9},                                              // D10
    .left = {part::kTimer3, part::kTimer3Clock, {'A', 6}, {'A', 7}},   // A2, A3
    .right = {part::kTimer4, part::kTimer4Clock, {'B', 6}, {'B', 7}},  // SCL, SDA
    .light = {'C', 1},                                                 // D13
    .power = std::nullopt,
    .stop = {'C', 2},  // D12
    .names = {"D6 sends, D5 receives", "SCL sends, SDA receives", "D10 data, D9 clock", "A2 and 3, SCL and SDA"},
};

}  // namespace fencepost::board::feather_f405
