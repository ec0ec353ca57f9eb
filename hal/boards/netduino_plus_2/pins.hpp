// Netduino Plus 2: a crystal of 25 MHz; its header gets 5 V while PB2 is high. Sources: MicroPython's board definition
// NETDUINO_PLUS_2, alternate functions by table 9 of the datasheet. The header's names are behind each pin.
#pragma once

#include "hal/boards/netduino_plus_2/wiring.hpp"

namespace fencepost::board::netduino_plus_2 {

namespace part = mcu::stm32f4;

inline constexpr Wiring kWiring = {
    .target = "netduino_plus_2",
    .crystals = {25},
    .console = {part::kUsart2Part, {'A', 2}, {'A', 3}},                // D3, D2
    .camera = {part::kUsart6Part, {'C', 6}, {'C', 7}},                 // D1, D0
    .base = {part::kUart4Part, {'A', 0}, {'A', 1}},                    // D8, D7
    .i2c_clock = {'B', 8},                                             // D5
    .i2c_data = {'B', 9},                                              // D6
    .left = {part::kTimer4, part::kTimer4Clock, {'B', 6}, {'B', 7}},   // SDA, SCL
    .right = {part::kTimer5, part::kTimer5Clock, {'A', 0}, {'A', 1}},  // D8, D7
    .light = {'A', 10},
    .power = part::Pin{'B', 2},
    .stop = {'B', 12},  // D4
    .names = {"D1 sends, D0 receives", "D8 sends, D7 receives", "D6 data, D5 clock", "SDA and SCL, D8 and D7"},
};

}  // namespace fencepost::board::netduino_plus_2
