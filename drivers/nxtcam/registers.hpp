// Registers of the NXTCam v1 to v4 on I2C. Source: NXTCam v4 user guide. v5 is taken to have the same.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "hal/sensor/blob_frame.hpp"

namespace fencepost::nxtcam {

/// 7 bits; LEGO's notation of the same is 0x02.
inline constexpr std::uint8_t kDefaultAddress = 0x01;

inline constexpr std::uint8_t kVersionRegister = 0x00;  ///< eight characters, padded with zeros or spaces
inline constexpr std::uint8_t kVendorRegister = 0x08;   ///< eight characters, and the product's eight behind them
inline constexpr std::uint8_t kCommandRegister = 0x41;
inline constexpr std::uint8_t kCountRegister = 0x42;  ///< then five bytes an object
inline constexpr std::uint8_t kColourMapRegister = 0x80;
inline constexpr std::size_t kColourMapSize = 48;
inline constexpr std::size_t kObjectSize = 5;
inline constexpr std::size_t kMaxObjects = 8;
inline constexpr std::size_t kMaxRead = 16;  ///< of one transaction, on the NXT

/// Written to the command register.
enum class Command : std::uint8_t {
  kSortBySize = 'A',
  kObjectMode = 'B',
  kDisableTracking = 'D',
  kEnableTracking = 'E',
  kFetchColourMap = 'G',  ///< from the engine into the registers
  kLockBuffer = 'J',      ///< later v4
  kUnlockBuffer = 'K',
};

/// `bytes`: vendor and product, sixteen characters. Any NXTCam is meant, whatever follows in the product's name.
bool is_nxtcam(std::span<const std::uint8_t> bytes);

/// Bit c is set if colour c was trained: some red, some green and some blue values belong to it. `map`: 48 bytes,
/// sixteen for each channel, a bit a colour in each (AVRcam's map). The order of the channels does not matter for this.
std::uint8_t taught_colours(std::span<const std::uint8_t> map);

inline constexpr std::int16_t kWidth = 176;   ///< of the image that coordinates refer to
inline constexpr std::int16_t kHeight = 144;  ///< the same

/// Five bytes: colour, x upper left, y upper left, x lower right, y lower right. The tracker works on 88 columns and
/// reports them doubled: where both x are even, the last column is x + 1. Firmware said to report single columns shows
/// by odd values and is taken as it is. The guide gives the range as 0..176 and 0..144; what lies on the border is put
/// on the last pixel. The centroid is the middle of the box. The colour's index, 0 to 7, is the signature.
/// errors: empty if the corners are in the wrong order or outside, or there is no such colour
std::optional<sensor::Blob> object_in(std::span<const std::uint8_t> bytes);

}  // namespace fencepost::nxtcam
