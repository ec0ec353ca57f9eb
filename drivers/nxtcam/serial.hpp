// The NXTCam's serial side: the AVRcam dialect of v1 to v4, and the frames inside v5.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "drivers/nxtcam/registers.hpp"
#include "drivers/wire/scanner.hpp"

namespace fencepost::nxtcam {

/// AVRcam: `0A n, n times (colour, x1, y1, x2, y2), FF` while tracking, lines `ACK\r` and `NCK\r` and the version's as
/// answers to commands. No checksum and no escaping: n gives the length; only the end mark and the
/// objects' plausibility reveal damage.
inline constexpr std::size_t kLongestTracking = 3 + kMaxObjects * kObjectSize;

inline constexpr std::string_view kPingLine = "PG\r";     ///< a command, ended by a carriage return, as the others
inline constexpr std::string_view kVersionLine = "GV\r";  ///< requests the version
inline constexpr std::string_view kEnableLine = "ET\r";   ///< tracking on
inline constexpr std::string_view kDisableLine = "DT\r";  ///< tracking off

/// For wire::Scanner: tracking packets, or lines of printable text up to 32 characters ended by a carriage return.
wire::Verdict examine_avrcam(std::span<const std::uint8_t> bytes);

/// A frame with the objects of a tracking packet and nothing else, the largest first, coordinates as in object_in.
/// errors: empty for a line of text, or if an object is impossible
std::optional<sensor::BlobFrame> tracking_in(std::span<const std::uint8_t> message);
/// A line without its end; empty for a tracking packet.
std::string_view line_in(std::span<const std::uint8_t> message);

/// v5: `55 AA length type data checksum`; the checksum is the sum of all bytes before it. Only blobs (type 4) are read:
/// frame, 0, colour, x, y, x + w, y + h on 240 x 160. Other types of at most 64 bytes are passed over by their length.
inline constexpr std::size_t kLongestV5 = 5 + 64;
inline constexpr std::int16_t kV5Width = 240;   ///< of the image that coordinates refer to
inline constexpr std::int16_t kV5Height = 160;  ///< the same

/// For wire::Scanner.
wire::Verdict examine_v5(std::span<const std::uint8_t> bytes);

struct V5Blob {
  std::uint8_t frame = 0;  ///< the camera's count; blobs of one frame share it
  sensor::Blob blob;       ///< x + w and y + h are one past the last pixel
};
/// errors: empty for other types, or if the box is not on the image
std::optional<V5Blob> v5_blob_in(std::span<const std::uint8_t> message);

}  // namespace fencepost::nxtcam
