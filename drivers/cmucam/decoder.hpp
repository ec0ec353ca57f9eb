// The byte stream of a CMUcam: acknowledgements, prompts, version texts, tracking packets in ASCII and raw.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "hal/base/units.hpp"

namespace fencepost::cmucam {

enum class Event : std::uint8_t {
  kNone,
  kAck,
  kNck,
  kPrompt,  ///< ':'; text() is what came before it on the line (a CMUcam3 ends its version text so)
  kText,    ///< any other line: a version text, or a damaged line
  kPacket,
};

/// One tracking packet as sent. M and T: mx my x1 y1 x2 y2 pixels confidence. C: the same without mx my. N: as M, after
/// a servo position. S: six colour figures in RGB order, twelve from a CMUcam4.
struct Packet {
  static constexpr std::size_t kMaxFields = 12;

  base::Time t;  ///< when its first byte arrived
  char letter = 0;
  std::uint8_t count = 0;
  std::array<std::uint8_t, kMaxFields> fields{};
};

/// Accepts both forms at any time. A raw packet is 0xFF, a letter and bytes below 0xFF, so 0xFF always starts a packet.
/// Everything else is text, which ends in CR. Neither form has a checksum: a damaged packet may still look like one.
/// Source: manuals of the CMUcam1 (1.12) and CMUcam2, source of the CMUcam3's emulation.
class Decoder {
 public:
  /// One byte that arrived at `now`.
  Event feed(std::uint8_t byte, base::Time now);

  /// Of the last kPacket.
  [[nodiscard]] const Packet& packet() const { return packet_; }
  /// Of the last kText or kPrompt, until the next byte.
  [[nodiscard]] std::string_view text() const { return {line_.data(), size_}; }
  /// Lines too long, raw packets cut short, letters unknown.
  [[nodiscard]] std::uint32_t broken() const { return broken_; }

 private:
  enum class Mode : std::uint8_t { kText, kSkipLine, kRawLetter, kRawFields };

  Event feed_text(std::uint8_t byte, base::Time now);
  Event end_line();
  void start_raw(base::Time now);
  Event feed_raw(std::uint8_t byte);
  bool parse_packet();

  // The longest packet of a CMUcam4 has 12 fields of three digits.
  static constexpr std::size_t kLine = 63;

  Mode mode_ = Mode::kText;
  bool fresh_ = true;  ///< the next text byte starts a line
  std::uint8_t size_ = 0;
  std::uint8_t wanted_ = 0;
  std::array<char, kLine> line_{};
  base::Time started_;
  Packet packet_;
  std::uint32_t broken_ = 0;
};

}  // namespace fencepost::cmucam
