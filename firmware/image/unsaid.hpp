// Defaults of what a board's board.hpp may leave out.
#pragma once

#include <cstdint>

#include "hal/bus/pin_names.hpp"

namespace fencepost::board {
namespace unsaid {

inline constexpr bool kOneLine = false;            ///< camera and wheel base share it
inline constexpr std::uint8_t kLowestAddress = 0;  ///< that the two-wire bus can speak to
inline constexpr bus::PinNames kPinNames;
inline constexpr int kEncoderBits = 16;
inline constexpr bool kMotors = false;  ///< two, by drive_motors; and a button
inline void drive_motors(std::int32_t /*percent*/) {}
inline bool button_held() { return false; }
inline bool supply_low() { return false; }  ///< below what the part needs for its speed or its flash

}  // namespace unsaid

// A name that the board says itself is found first.
using namespace unsaid;  // NOLINT(google-build-using-namespace)

}  // namespace fencepost::board
