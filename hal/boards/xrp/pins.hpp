// XRP robot with the controller of 2023, a Pico W. Source: MicroPython's board definition SPARKFUN_XRP_CONTROLLER_BETA;
// functions by the RP2040 datasheet, 2.19.2. Its light hangs at the wireless chip, which nothing here drives. Motors 3
// and 4 are not used: their encoders' pins are the serial lines.
#pragma once

#include "hal/boards/pico/wiring.hpp"
#include "hal/mcu/rp2040/registers.hpp"

namespace fencepost::board::xrp {

namespace part = mcu::rp2040;

inline constexpr Wiring kWiring = {
    .target = "xrp",
    .console = {part::kUart0, part::kResetUart0, part::kInterruptUart0, {0}, {1}},  // encoder of motor 3
    .camera = {part::kUart1, part::kResetUart1, part::kInterruptUart1, {8}, {9}},   // encoder of motor 4
    .i2c = {part::kI2c1, part::kResetI2c1, part::kInterruptI2c1, {18}, {19}},  // Qwiic; the board's own sensor, too
    .left = {{4}, {5}},
    .right = {{13}, {12}},  // mounted the other way round: forwards, B leads
    .light = std::nullopt,
    .stop = {17},  // servo 2
    // Phase and enable; the left motor is mounted the other way round (Open-STEM/XRP_MicroPython, XRPLib: motor.py,
    // SinglePWMMotor, and encoded_motor.py).
    .left_motor = {.power = {7}, .direction = part::Pin{6}, .ahead = true},
    .right_motor = {.power = {15}, .direction = part::Pin{14}, .ahead = false},
    .names = {"GP8 sends, GP9 receives", "GP8 sends, GP9 receives", "GP18 data, GP19 clock", "its own"},
};

}  // namespace fencepost::board::xrp
