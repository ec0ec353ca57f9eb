// Options that several devices have.
#pragma once

#include <fmt/format.h>

#include "host/devices/row.hpp"

namespace fencepost::devices {

inline constexpr std::uint32_t kSlowestBaud = 50;
inline constexpr std::uint32_t kFastestBaud = 4'000'000;

/// Baud rate of a serial port; unknown on a TCP connection.
inline Option baud(std::uint32_t as_delivered) {
  return {"baud", Whole{kSlowestBaud, kFastestBaud}, std::to_string(as_delivered), "", {PlaceKind::kTty}};
}

/// Baud rate of an emulated device's line, 0: as fast as it goes. `as_delivered` 0: it has no UART.
inline Option line_baud(std::uint32_t as_delivered) {
  return {"baud", Whole{kSlowestBaud, kFastestBaud, true}, std::to_string(as_delivered)};
}

/// On I2C, seven bits.
inline Option address(std::uint8_t as_delivered, std::vector<PlaceKind> places = {PlaceKind::kI2c}) {
  return {"address", Whole{1, 127}, fmt::format("{:#04x}", as_delivered), "", std::move(places)};
}

/// Serial number, to choose one of several on USB.
inline Option serial() { return {"serial", AnyText{}, "", "of the one that is meant", {PlaceKind::kUsb}}; }

/// The limits of an emulated camera, with the image of its driver's profile.
struct Blobs {
  std::size_t most = 16;
  std::size_t of_signature = 16;
  std::uint8_t first_signature = 0;
  std::uint8_t last_signature = 255;
};
inline emulate::ImageLimits image_of(const sensor::CameraIntrinsics& profile, const Blobs& blobs, double rate) {
  return {profile.width,         profile.height,       blobs.most, blobs.of_signature,
          blobs.first_signature, blobs.last_signature, rate};
}

/// The options of an emulated wheel base.
inline std::vector<Option> wheel_options(std::uint32_t baud, const emulate::WheelShape& wheels) {
  return {line_baud(baud),
          {"tick", Metres{1}, fmt::format("{}", wheels.tick), "m of the rim a count"},
          {"track", Metres{10}, fmt::format("{}", wheels.track), "m between the wheels"}};
}

}  // namespace fencepost::devices
