// A line being typed on a terminal that neither echoes nor edits: the status line shows it.
#pragma once

#include <optional>
#include <string>

namespace fencepost::host {

class TypedLine {
 public:
  /// One byte of the keyboard; with Enter the line, which is then cleared. Backspace and Ctrl-U work, cursor keys and
  /// other control characters are passed over.
  std::optional<std::string> push(char byte);
  [[nodiscard]] const std::string& text() const { return text_; }

  static constexpr std::size_t kLongest = 1023;  ///< a robot discards longer lines

 private:
  enum class Escape : unsigned char { kNone, kBegun, kWithin };
  bool in_escape(char byte);
  void erase_last();

  std::string text_;
  Escape escape_ = Escape::kNone;
};

}  // namespace fencepost::host
