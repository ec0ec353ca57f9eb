// Lines of a text that others printed, with what the Arduino IDE's monitor may put before each.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fencepost::host {

/// "HH:MM:SS.mmm -> " taken off, seconds of the day.
struct StampedLine {
  std::string_view text;
  std::optional<double> t;
};
StampedLine without_stamp(std::string_view line);

/// Each line without its end: LF, CR LF, or CR where there is no LF at all.
std::vector<std::string_view> lines_of(std::string_view text);

/// Without blanks around it.
std::string_view trimmed_text(std::string_view text);

/// In lower case; letters beyond ASCII stay.
std::string lower(std::string_view text);

/// A whole plain number, with nothing behind it.
std::optional<double> number_in(std::string_view text);

/// The number behind `key` in "x: 12 y: 34" or "x=12,y=34"; the key is a whole word.
std::optional<double> value_after(std::string_view line, std::string_view key);

/// The text for messages: printable, and not too much of it.
std::string quoted(std::string_view text);

/// Separated by blanks.
std::vector<std::string_view> words_of(std::string_view line);

}  // namespace fencepost::host
