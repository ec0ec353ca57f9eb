// pyboard: a crystal of 8 MHz (1.0) or 12 MHz (1.1). Sources: MicroPython's board definitions PYBV10 and PYBV11,
// alternate functions by table 9 of the datasheet. The header's names are behind each pin.
#pragma once

#include "hal/boards/netduino_plus_2/wiring.hpp"

namespace fencepost::board::pyboard {

namespace part = mcu::stm32f4;

inline constexpr Wiring kWiring = {
    .target = "pyboard",
    .crystals = {12, 8},
    .console = {part::kUsart2Part, {'A', 2}, {'A', 3}},                // X3, X4
    .camera = {part::kUsart6Part, {'C', 6}, {'C', 7}},                 // Y1, Y2
    .base = {part::kUsart3Part, {'B', 10}, {'B', 11}},                 // Y9, Y10
    .i2c_clock = {'B', 8},                                             // Y3
    .i2c_data = {'B', 9},                                              // Y4
    .left = {part::kTimer3, part::kTimer3Clock, {'A', 6}, {'A', 7}},   // X7, X8
    .right = {part::kTimer4, part::kTimer4Clock, {'B', 6}, {'B', 7}},  // X9, X10
    .light = {'B', 4},                                                 // the blue one; two of the others are SWD
    .power = std::nullopt,
    .stop = {'B', 12},  // Y5
    .names = {"Y1 sends, Y2 receives", "Y9 sends, Y10 receives", "Y4 data, Y3 clock", "X7 and 8, X9 and 10"},
};

}  // namespace fencepost::board::pyboard
