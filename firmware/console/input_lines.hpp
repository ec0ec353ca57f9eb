// Bytes from the link to lines, in one buffer: the link reads into it, lines are handed out where they lie.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "firmware/record/records.hpp"

namespace fencepost::console {

class InputLines {
 public:
  /// A line ends with CR or LF, the two together are one end. One of at most kMaxLine - 1 characters fits.
  struct Line {
    std::span<char> text;  ///< without its end; of one that was too long, the first 16 characters and some of the last
    bool too_long = false;
  };

  /// The room for the next bytes; empty while a whole line waits and the buffer is full.
  std::span<std::uint8_t> room();
  /// `count` bytes were put at the front of room().
  void filled(std::size_t count);

  /// The oldest whole line; it stays until pop_front().
  std::optional<Line> front();
  void pop_front();

 private:
  static constexpr std::uint16_t kSize = record::kMaxLine;
  // Bytes that are kept of a line that is too long: enough to distinguish a record from a command.
  static constexpr std::uint16_t kKept = 16;

  void shorten();

  std::array<char, kSize> bytes_{};
  std::uint16_t begin_ = 0;
  std::uint16_t scanned_ = 0;  ///< there is no line end before this
  std::uint16_t end_ = 0;
  bool after_return_ = false;  ///< the last line ended with '\r': a '\n' now is part of that end
  bool too_long_ = false;
};

}  // namespace fencepost::console
