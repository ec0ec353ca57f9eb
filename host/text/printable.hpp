// Text from logs, robots and scenes is shown on terminals. Nothing in it may move the cursor, change a colour or begin
// a line of its own.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace fencepost::host {

/// Reads UTF-8 byte by byte and says what a terminal may get. Control characters, C1 ones too, and bytes that belong to
/// no character become '?', and so do characters that turn the direction of text. A string may come in portions; its
/// length stays.
class PrintableBytes {
 public:
  char next(char c);
  /// Bytes of a character whose last ones are still to come.
  [[nodiscard]] int begun() const { return missing_ > 0 ? begun_ : 0; }
  /// Bytes before the last one that began a character whose rest never came, or which is not shown.
  [[nodiscard]] int broken_off() const { return broken_off_; }

 private:
  char begin(std::uint8_t byte);
  char ended(char c);

  int begun_ = 0;
  int missing_ = 0;
  int broken_off_ = 0;
  std::uint8_t low_ = 0x80;  ///< allowed for the next byte
  std::uint8_t high_ = 0xBF;
  std::uint32_t character_ = 0;  ///< its bytes so far
};

/// One line of text: line ends and tabs become '?' like other control characters; all other UTF-8 stays.
std::string printable(std::string_view text);

}  // namespace fencepost::host
