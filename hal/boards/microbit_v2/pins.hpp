// BBC micro:bit v2. Source: the pin map of its schematic, V2.00 (tech.microbit.org, hardware).
#pragma once

#include <cstdint>

#include "hal/bus/pin_names.hpp"
#include "hal/mcu/nrf52/pin.hpp"

namespace fencepost::board::microbit_v2 {

namespace part = mcu::nrf52;

inline constexpr std::uint32_t kSecondPort = 32;  // P1.00

inline constexpr part::Pin kConsoleSends{6};  // to the interface chip, whose USB has a serial line
inline constexpr part::Pin kConsoleReceives{kSecondPort + 8};
inline constexpr part::Pin kBusClock{26};              // edge connector 19; the board's own sensors have another bus
inline constexpr part::Pin kBusData{kSecondPort + 0};  // edge connector 20
// A pixel shines where its row is high and its column low: five rows of five. Those of the first column are used.
inline constexpr part::Pin kHeartbeatRow{21};  // the first
inline constexpr part::Pin kHeldRow{19};       // the last
inline constexpr part::Pin kLitColumn{28};
inline constexpr part::Pin kDarkColumns[] = {{11}, {31}, {kSecondPort + 5}, {30}};
// For a camera or a wheel base, where a crocodile clip reaches.

inline constexpr part::Pin kLineSends{4};     // ring 2
inline constexpr part::Pin kLineReceives{2};  // ring 0

// Encoders, on the edge connector.

inline constexpr part::Pin kLeftA{17};                // 13
inline constexpr part::Pin kLeftB{1};                 // 14
inline constexpr part::Pin kRightA{13};               // 15
inline constexpr part::Pin kRightB{kSecondPort + 2};  // 16
/// Low stops the motors: the ring 1 of the edge connector.
inline constexpr part::Pin kStop{3};
/// Of the button on the back, by the interface chip.
inline constexpr part::Pin kReset{18};
/// On the edge connector, as `status` says them.
inline constexpr bus::PinNames kNames = {"ring 2 sends, ring 0 receives", "ring 2 sends, ring 0 receives",
                                         "20 data, 19 clock", "13 and 14, 15 and 16"};

}  // namespace fencepost::board::microbit_v2
