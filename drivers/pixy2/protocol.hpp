// Packets of the Pixy2, both ways. Source: serial protocol reference of the vendor, firmware 3.0.20.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "drivers/wire/scanner.hpp"
#include "hal/base/fixed.hpp"
#include "hal/sensor/blob_frame.hpp"

namespace fencepost::pixy2 {

/// `<sync> C1 <type> <length> <checksum, 2> <data>`; the checksum is the sum of the data bytes, little-endian as
/// everything. The camera answers so whether or not the request had a checksum.
inline constexpr std::uint8_t kSync = 0xAF;        ///< begins a packet with checksum
inline constexpr std::uint8_t kSecondSync = 0xC1;  ///< follows it
inline constexpr std::size_t kHeader = 6;          ///< bytes before the data
inline constexpr std::size_t kLongestPacket = kHeader + 255;

enum class Type : std::uint8_t {
  kResult = 0x01,
  kChangeProgram = 0x02,
  kError = 0x03,
  kGetResolution = 0x0C,
  kResolution = 0x0D,
  kGetVersion = 0x0E,
  kVersion = 0x0F,
  kSetBrightness = 0x10,
  kSetServos = 0x12,
  kSetLed = 0x14,
  kSetLamp = 0x16,
  kGetFps = 0x18,
  kGetBlocks = 0x20,
  kBlocks = 0x21,
};

/// Data of an error packet.
enum class DeviceError : std::int8_t {
  kGeneral = -1,
  kBusy = -2,  ///< no new frame yet; of a version request: still starting
  kInvalidRequest = -3,
  kUnsupported = -4,     ///< of blocks: another program runs
  kButton = -5,          ///< a signature is being trained by the button
  kProgramChanging = -6  ///< soon
};

/// The program that finds coloured blobs, as the firmware calls it; padded with zeros to 33 bytes in its request.
inline constexpr std::size_t kProgramName = 33;
inline constexpr std::size_t kPadding = 64;  ///< filler bytes before a request
inline constexpr std::size_t kLongestRequest = kPadding + kHeader + kProgramName;
using Request = base::FixedVector<std::uint8_t, kLongestRequest>;

/// A request with checksum: the camera drops one whose data were damaged. `data` at most 33 bytes.
Request make_request(Type type, std::span<const std::uint8_t> data);
Request request_version();
Request request_program();
Request request_resolution();
/// `signatures`: bit n-1 for signature n, bit 7 for colour codes; 0 is refused by the camera. Asks for all blocks.
Request request_blocks(std::uint8_t signatures);

/// Preceded by filler bytes. A request with a damaged length makes the camera wait for data indefinitely: these
/// complete it, with a wrong checksum.
Request behind_padding(const Request& request);

/// For wire::Scanner; knows the types of answers only, and their lengths. Over SPI the first sync byte may come twice,
/// and 01 is filler between packets.
wire::Verdict examine(std::span<const std::uint8_t> bytes);

/// For wire::Scanner: our own requests, for a link that takes them apart again.
wire::Verdict examine_request(std::span<const std::uint8_t> bytes);

/// Of a message as the scanner gives it; borrowed.
struct Packet {
  Type type = Type::kError;
  std::span<const std::uint8_t> data;
};
Packet packet_of(std::span<const std::uint8_t> message);

struct Version {
  std::uint16_t hardware = 0;
  std::uint8_t major = 0;
  std::uint8_t minor = 0;
  std::uint16_t build = 0;
  base::FixedString<10> type;  ///< of the firmware, such as "general"
  friend constexpr bool operator==(const Version&, const Version&) = default;
};

/// errors, of all that follow: empty if the packet's type or length is another
std::optional<Version> version_in(const Packet& packet);
std::optional<std::int32_t> result_in(const Packet& packet);
std::optional<DeviceError> error_in(const Packet& packet);

struct Resolution {
  std::uint16_t width = 0;
  std::uint16_t height = 0;
  friend constexpr bool operator==(Resolution, Resolution) = default;
};
std::optional<Resolution> resolution_in(const Packet& packet);

/// Image of the program for coloured blobs.
inline constexpr Resolution kBlobResolution = {316, 208};

struct Blocks {
  sensor::BlobFrame frame;    ///< its blobs only, the largest first
  std::uint32_t dropped = 0;  ///< beyond sixteen, or colour codes above 255
};

/// Boxes in our convention. The camera reports the box as centre (rounded down) and size. Its columns end one past the
/// last pixel (run lengths): x2 = left + width - 1. Its rows end with the last one (the assembler's row): y2 = top +
/// height. The centroid is the middle of the box: the camera has no other. A colour code's signature is its octal
/// number. A block's id is its tracker's index plus 1: the camera sends only blocks that a tracker has.
/// errors: also empty if any box is outside of the image or has signature 0
std::optional<Blocks> blocks_in(const Packet& packet);

}  // namespace fencepost::pixy2
