// The description inside an image for a program that reads its file (`fencepost configure`), beside mcu::AboutBoard.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "firmware/config/devices.hpp"

namespace fencepost::config {

/// Likewise found by its first bytes, and little-endian.
struct AboutImage {
  static constexpr std::string_view kMark = "fencepost image 2";
  static constexpr std::size_t kVersion = 14;

  std::array<char, 17> mark{};
  std::array<char, kVersion> version{};  ///< zeros behind it
  std::uint8_t signatures = 0;           ///< that it has room for
  std::uint32_t cameras = 0;             ///< as DeviceLimits has them, here and below
  std::uint32_t odometries = 0;
  std::uint32_t one_line = 0;
  std::uint32_t lowest_address = 0;
  std::uint32_t motors = 0;
  std::array<std::int32_t, kDeviceKeys> initial{};
};
static_assert(sizeof(AboutImage) == 52 + 4 * kDeviceKeys);

constexpr AboutImage about_image(std::string_view version, std::size_t signatures, const DeviceLimits& limits) {
  AboutImage about;
  AboutImage::kMark.copy(about.mark.data(), about.mark.size());
  version.copy(about.version.data(), about.version.size());  // cut to the field's size
  about.signatures = static_cast<std::uint8_t>(signatures);
  about.cameras = limits.cameras;
  about.odometries = limits.odometries;
  about.one_line = limits.one_line ? 1 : 0;
  about.lowest_address = limits.lowest_address;
  about.motors = limits.motors ? 1 : 0;
  for (std::size_t i = 0; i < kDeviceKeys; ++i) about.initial[i] = limits.initial.raw(static_cast<DeviceKey>(i));
  return about;
}

}  // namespace fencepost::config
