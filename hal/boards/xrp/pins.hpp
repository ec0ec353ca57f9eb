// XRP robot with the controller of 2023, a Pico W. Source: MicroPython's board definition SPARKFUN_XRP_CONTROLLER_BETA;
// functions by the RP2040 datasheet, 2.19.2. Its light hangs at the wireless chip, which nothing here drives. Its
// console is on USB alone: all other pins of a UART are plugs of motors 3 and 4, whose encoders would drive against it.
#pragma once

#include "hal/boards/pico/wiring.hpp"
#include "hal/mcu/rp2/part.hpp"

namespace fencepost::board::xrp {

namespace part = mcu::rp2;

inline constexpr Wiring kWiring = {
    .target = "xrp",
    .console = std::nullopt,
    .camera = {part::kUart0, part::kResetUart0, part::kInterruptUart0, {16}, {17}},  // servos 1 and 2
    .i2c = {part::kI2c1, part::kResetI2c1, part::kInterruptI2c1, {18}, {19}},  // Qwiic; the board's own sensor, too
    .left = {{4}, {5}},
    .right = {{13}, {12}},  // mounted the other way round: forwards, B leads
    .light = std::nullopt,
    .button = {22},
    .stop = {20},  // an input of the distance sensor that may hang there
    // Phase and enable; the left motor is mounted the other way round (Open-STEM/XRP_MicroPython, XRPLib: motor.py,
    // SinglePWMMotor, and encoded_motor.py).
    .left_motor = {.power = {7}, .direction = part::Pin{6}, .ahead = true},
    .right_motor = {.power = {15}, .direction = part::Pin{14}, .ahead = false},
    .names = {"GP16 sends, GP17 receives", "GP16 sends, GP17 receives", "GP18 data, GP19 clock", "its own"},
};

}  // namespace fencepost::board::xrp
