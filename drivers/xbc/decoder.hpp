// XBC-L, the lines that fencepost_xbc.ic sends, to frames.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "hal/base/units.hpp"
#include "hal/sensor/blob_frame.hpp"

namespace fencepost::xbc {

/// The XBC's vision code passes columns 0..355; a width of 352 is quoted too.
inline constexpr std::int16_t kWidth = 356;
/// It passes rows 0..290; heights of 278 and 292 are quoted too.
inline constexpr std::int16_t kHeight = 291;
inline constexpr std::size_t kChannels = 3;  ///< of colour

enum class Event : std::uint8_t {
  kNone,
  kFrame,    ///< frame() is new
  kVersion,  ///< version() is new
};

struct Counts {
  std::uint32_t damaged = 0;     ///< lines with a bad checksum or without one, too long, or cut off
  std::uint32_t impossible = 0;  ///< whole lines with impossible values
  std::uint32_t incomplete = 0;  ///< frames dropped because a line of theirs was
  std::uint32_t dropped = 0;     ///< blobs of good frames beyond the capacity
};

/// A frame is a line F, its lines B, a line E. `$F frame n*hh`. `$B ch idx x y size conf left top right bottom
/// angle*hh`. `$E frame*hh`. `$V XBCL version*hh` has the version. hh is the exclusive or of the characters between `$`
/// and `*`. A frame counts only if all of its lines are good.
/// `$` starts a line wherever it stands. LF or CR LF.
/// The XBC counts pixels from 0, to the right and down, ends inclusive: as we do.
class Decoder {
 public:
  /// The signature of each of the XBC's channels.
  explicit Decoder(std::array<std::uint8_t, kChannels> signatures) : signatures_(signatures) {}

  /// One byte that arrived at `now`.
  Event feed(std::uint8_t byte, base::Time now);

  /// Forgets a line and a frame that have begun.
  void reset() { in_line_ = building_ = false; }

  [[nodiscard]] const sensor::BlobFrame& frame() const { return frame_; }
  [[nodiscard]] std::int32_t version() const { return version_; }
  [[nodiscard]] const Counts& counts() const { return counts_; }

 private:
  Event end_line();
  Event obey(std::string_view body);
  Event begin_frame(std::string_view fields);
  Event add_blob(std::string_view fields);
  Event end_frame(std::string_view fields);
  Event impossible();
  void abandon();

  // The longest line B has 52 characters.
  static constexpr std::size_t kLine = 64;

  std::array<std::uint8_t, kChannels> signatures_;
  std::array<char, kLine> line_{};
  std::uint8_t size_ = 0;
  bool in_line_ = false;
  base::Time line_t_;

  bool building_ = false;
  std::int32_t announced_ = 0;
  std::int32_t received_ = 0;
  std::uint32_t over_ = 0;
  sensor::BlobFrame next_;
  sensor::BlobFrame frame_;
  std::int32_t version_ = 0;
  Counts counts_;
};

}  // namespace fencepost::xbc
