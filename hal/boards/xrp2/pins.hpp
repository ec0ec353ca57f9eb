// XRP robot with the controller that shops sell since late 2024 (RP2350B). Source: MicroPython's board definition
// SPARKFUN_XRP_CONTROLLER; functions by the RP2350 datasheet, 9.4. One of its lights hangs at the wireless chip, the
// other takes a protocol of its own: nothing here drives them. Its console is on USB alone, as the older robot's.
#pragma once

#include "hal/boards/pico/wiring.hpp"
#include "hal/mcu/rp2/part.hpp"

namespace fencepost::board::xrp2 {

namespace part = mcu::rp2;

inline constexpr Wiring kWiring = {
    .target = "xrp2",
    .console = std::nullopt,
    .camera = {part::kUart1, part::kResetUart1, part::kInterruptUart1, {8}, {9}},  // servos 4 and 2
    .i2c = {part::kI2c0, part::kResetI2c0, part::kInterruptI2c0, {4}, {5}},        // Qwiic 0
    .left = {{30}, {31}},
    .right = {{25}, {24}},  // mounted the other way round: forwards, B leads
    .light = std::nullopt,
    .button = {36},
    .stop = {0},  // an input of the distance sensor that may hang there
    // An input for each direction, of which one stays low; the left motor is mounted the other way round
    // (Open-STEM/XRP_MicroPython, XRPLib: motor.py, DualPWMMotor, and encoded_motor.py).
    .left_motor = {.power = {34}, .direction = part::Pin{35}, .ahead = false},
    .right_motor = {.power = {33}, .direction = part::Pin{32}, .ahead = false},
    .names = {"GP8 sends, GP9 receives", "GP8 sends, GP9 receives", "GP4 data, GP5 clock", "its own"},
};

}  // namespace fencepost::board::xrp2
