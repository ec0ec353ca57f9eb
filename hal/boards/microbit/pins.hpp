// BBC micro:bit v1. Source: its schematic, v1.3B.
#pragma once

#include <cstdint>

#include "hal/mcu/nrf51/pin.hpp"

namespace fencepost::board::microbit {

namespace part = mcu::nrf51;

inline constexpr part::Pin kConsoleSends{24};  // to the interface chip, whose USB has a serial line
inline constexpr part::Pin kConsoleReceives{25};
inline constexpr part::Pin kBusClock{0};  // edge connector 19; the board's own sensors share the bus
inline constexpr part::Pin kBusData{30};  // edge connector 20
// A pixel shines where its row is high and its column low: three rows of nine, P0.13 to 15 by P0.04 to 12.
inline constexpr part::Pin kFirstRow{13};
inline constexpr std::uint32_t kFirstColumn = 4;  // of the same port
inline constexpr std::uint32_t kColumns = 9;
/// Low stops the motors: the ring 1 of the edge connector.
inline constexpr part::Pin kStop{2};

}  // namespace fencepost::board::microbit
