// BBC micro:bit v2. Source: the pin map of its schematic, V2.00 (tech.microbit.org, hardware).
#pragma once

#include <cstdint>

#include "hal/mcu/nrf52/pin.hpp"

namespace fencepost::board::microbit_v2 {

namespace part = mcu::nrf52;

inline constexpr std::uint32_t kSecondPort = 32;  // P1.00

// To the interface chip, whose USB has a serial line.
inline constexpr part::Pin kConsoleSends{6};
inline constexpr part::Pin kConsoleReceives{kSecondPort + 8};
// Edge connector 19 and 20; the board's own sensors are on another bus.
inline constexpr part::Pin kBusClock{26};
inline constexpr part::Pin kBusData{kSecondPort + 0};
// A pixel shines where its row is high and its column low: five rows of five. Those of the first column are used.
inline constexpr part::Pin kHeartbeatRow{21};  // the first
inline constexpr part::Pin kHeldRow{19};       // the last
inline constexpr part::Pin kLitColumn{28};
inline constexpr part::Pin kDarkColumns[] = {{11}, {31}, {kSecondPort + 5}, {30}};
/// Low stops the motors: the ring 1 of the edge connector.
inline constexpr part::Pin kStop{3};
/// Of the button on the back, by the interface chip.
inline constexpr part::Pin kReset{18};

}  // namespace fencepost::board::microbit_v2
