// Frames of a HuskyLens, of both generations. Sources: the vendor's protocol 0.5.1 and its libraries for Arduino.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "drivers/wire/scanner.hpp"
#include "hal/sensor/blob_frame.hpp"

namespace fencepost::huskylens {

enum class Generation : std::uint8_t { kOne, kTwo };

inline constexpr std::uint16_t kWidth = 320;
inline constexpr std::uint16_t kHeight = 240;
inline constexpr std::uint16_t kWidth2 = 640;  ///< of HuskyLens 2
inline constexpr std::uint16_t kHeight2 = 480;

/// HuskyLens 1: `55 AA 11 <length> <command> <data> <checksum>`; 2: `55 AA <command> <algorithm> <length> <data>
/// <checksum>`. The checksum is the low byte of the sum of all before it.
inline constexpr std::size_t kAround = 6;  ///< bytes of a frame without its data
/// Maximum data bytes of a frame. A block of HuskyLens 2 ends with its colour's name; with a longer name it is not
/// read.
inline constexpr std::size_t kLongestData = 64;
inline constexpr std::size_t kLongestFrame = kAround + kLongestData;  ///< bytes

/// For wire::Scanner; knows the answers that there are, and their lengths.
wire::Verdict examine(std::span<const std::uint8_t> bytes);

enum class Kind : std::uint8_t { kDone, kBusy, kInfo, kBlock, kArrow, kOther };

struct Message {
  Generation generation = Generation::kOne;
  Kind kind = Kind::kOther;
  std::span<const std::uint8_t> data;  ///< borrowed
};
Message message_of(std::span<const std::uint8_t> frame);

/// The INFO before the objects.
struct Info {
  std::uint16_t objects = 0;
  bool taught = false;                  ///< something was learned
  std::optional<std::uint16_t> number;  ///< of the image; HuskyLens 2 does not report it
};
Info info_in(const Message& message);

/// 0: not learned
std::uint16_t id_in(const Message& block);

/// A block's box in our convention, in an image of `width` columns, 320 or 640, whichever generation it is of. The
/// camera reports the middle (rounded up) and the size. Parts outside the image are cut off.
/// errors: empty if it has no size, lies outside, or its id is not reportable (1 to 255)
std::optional<sensor::Blob> blob_in(const Message& block, std::uint16_t width);

}  // namespace fencepost::huskylens
