// The colours of the picture, by number.
#pragma once

#include <cstdint>

#include "firmware/record/records.hpp"
#include "hal/bus/screen.hpp"

namespace fencepost::view {

inline constexpr std::uint8_t kGround = 0;
inline constexpr std::uint8_t kGrid = 1;
inline constexpr std::uint8_t kSide = 2;  ///< of the text beside the map
inline constexpr std::uint8_t kText = 3;
inline constexpr std::uint8_t kFaint = 4;
inline constexpr std::uint8_t kRobot = 5;
inline constexpr std::uint8_t kOnLevel = 6;
inline constexpr std::uint8_t kLevels = 8;     ///< and the three after it, by alert level
inline constexpr std::uint8_t kObjects = 16;   ///< by the object's slot, as the camera was taught its signature
inline constexpr std::uint8_t kOutlines = 64;  ///< likewise, lighter

inline constexpr bus::Colour kFixedColours[] = {
    {16, 20, 24},
    {40, 46, 54},
    {0, 0, 0},
    {232, 232, 232},
    {144, 152, 160},
    {248, 248, 248},
    {0, 0, 0},
    {0, 0, 0},
    // clear, notice, warn, stop: without colour, the word and the brightness distinguish them
    {40, 160, 88},
    {72, 152, 240},
    {248, 176, 24},
    {248, 56, 40}};

/// Half way to white.
constexpr bus::Colour lighter(bus::Colour colour) {
  const auto light = [](std::uint8_t value) { return static_cast<std::uint8_t>((value + 255) / 2); };
  return {light(colour.red), light(colour.green), light(colour.blue)};
}

constexpr std::uint8_t colour_of(record::AlertLevel level) {
  return static_cast<std::uint8_t>(kLevels + static_cast<std::uint8_t>(level));
}

}  // namespace fencepost::view
