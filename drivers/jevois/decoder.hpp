// The standardized serial messages of a JeVois, to frames.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "hal/base/fixed.hpp"
#include "hal/base/units.hpp"
#include "hal/sensor/blob_frame.hpp"
#include "hal/sensor/camera.hpp"

namespace fencepost::jevois {

/// Messages carry no resolution: whatever it is, x is -1000..1000 and y -750..750. This is the width they convert to.
inline constexpr std::int16_t kWidth = 320;
inline constexpr std::int16_t kHeight = 240;  ///< the same for rows
inline constexpr std::size_t kMaxNames = 8;   ///< capacity of Names

/// A module's name for a thing, and the signature that it gets.
struct Name {
  sensor::Text id;
  std::uint8_t signature = 0;
};
using Names = base::FixedVector<Name, kMaxNames>;

enum class Event : std::uint8_t {
  kNone,
  kLine,   ///< a line that belongs to the protocol
  kFrame,  ///< frame() is new
};

struct Counts {
  std::uint32_t damaged = 0;     ///< lines that are no message and no answer, or too long
  std::uint32_t impossible = 0;  ///< messages with impossible values
  std::uint32_t unused =
      0;  ///< messages that tell no box: 1D, 3D, terse, objects' categories; their frames do not count
  std::uint32_t incomplete = 0;  ///< frames dropped because a line of theirs was, or a mark is missing
  std::uint32_t dropped = 0;     ///< blobs of good frames beyond the capacity
};

/// A frame is a line `MARK START`, its messages and `MARK STOP`, each with or without a stamp before it. Of `N2 id x y
/// w h` the box is read, of `D2` and `F2` the vertices, whose box it is. A count of vertices may precede them: the
/// sources write it, the manual does not. An id is one of the names, else the number at its end (`blob2`), else 1.
/// JeVois counts pixels' edges: column 0 begins at x = -1000. The box of pixels a to b is b - a + 1 wide. CR LF, LF or
/// CR. No message has a checksum: a frame counts only if each of its lines is understood.
class Decoder {
 public:
  explicit Decoder(const Names& names) : names_(names) {}

  /// One byte that arrived at `now`.
  Event feed(std::uint8_t byte, base::Time now);

  /// Forgets a line and a frame that have begun.
  void reset() {
    size_ = 0;
    too_long_ = building_ = false;
  }

  [[nodiscard]] const sensor::BlobFrame& frame() const { return frame_; }
  /// The last frame had numbers of one decimal and the frame's stamp.
  [[nodiscard]] bool as_told() const { return as_told_; }
  [[nodiscard]] const Counts& counts() const { return counts_; }

 private:
  Event end_line();
  Event mark(std::string_view which, std::optional<std::uint32_t> stamp);
  Event message(std::string_view line);
  Event add(std::string_view id, std::span<const std::int32_t, 4> edges);
  Event refuse(std::uint32_t& counter);
  [[nodiscard]] std::uint8_t signature_of(std::string_view id) const;

  // An F2 of eight vertices behind the longest stamp.
  static constexpr std::size_t kLine = 192;

  Names names_;
  std::array<char, kLine> line_{};
  std::uint8_t size_ = 0;
  bool too_long_ = false;
  base::Time line_t_;

  bool building_ = false;
  std::optional<std::uint32_t> stamp_;
  bool as_told_ = false;
  std::uint32_t over_ = 0;
  sensor::BlobFrame next_;
  sensor::BlobFrame frame_;
  Counts counts_;
};

}  // namespace fencepost::jevois
