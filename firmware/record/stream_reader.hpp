// Bytes in any portions to records: cuts lines at '\n' and survives whatever a serial line delivers.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "firmware/record/line_reader.hpp"
#include "firmware/record/text.hpp"

namespace fencepost::record {

class StreamReader {
 public:
  /// The line is collected in `buffer`, which must outlive the reader and hold at least kMinBuffer characters. With
  /// kBuffer it holds any valid line; with less, longer lines are rejected (`length`).
  explicit StreamReader(std::span<char> buffer);

  static constexpr std::size_t kBuffer = kMaxLine - 1;  ///< without the '\n'
  static constexpr std::size_t kMinBuffer = 8;

  /// One byte; at a line's end its outcome, within a line nothing.
  template <RecordSink Sink>
  std::optional<LineOutcome> push(char byte, Sink& sink, const DecodeOptions& options = {}) {
    if (byte != '\n') {
      store(byte);
      return std::nullopt;
    }
    const std::optional<std::string_view> line = cut_line();
    return line ? lines_.take_line(*line, sink, options) : end_long_line();
  }

  /// Many bytes: takes those of one line, its end included, off the front of `bytes`, or all of them if no line ends
  /// there. The outcome of the line that ended, if one did. A line that is whole in there is not copied.
  template <RecordSink Sink>
  std::optional<LineOutcome> take(std::string_view& bytes, Sink& sink, const DecodeOptions& options = {}) {
    const std::string_view part = before(bytes, '\n');
    const bool ended = part.size() < bytes.size();
    bytes = after(bytes, part.size() + 1);
    if (ended && size_ == 0 && part.size() <= buffer_.size()) {
      return lines_.take_line(without_return(part), sink, options);
    }
    store(part);
    return ended ? push('\n', sink, options) : std::nullopt;
  }

  template <RecordSink Sink>
  void push(std::string_view bytes, Sink& sink, const DecodeOptions& options = {}) {
    for (const char byte : bytes) push(byte, sink, options);
  }

  /// The stream has ended. An unfinished line is counted (`truncated`, or foreign) and never delivered.
  std::optional<LineOutcome> finish();

  [[nodiscard]] const Counts& counts() const { return lines_.counts(); }
  [[nodiscard]] std::uint32_t line_number() const { return lines_.line_number(); }
  [[nodiscard]] std::optional<std::uint32_t> other_format() const { return lines_.other_format(); }

 private:
  void store(char byte);
  void store(std::string_view bytes);
  static std::string_view without_return(std::string_view line) {
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }
  /// The finished line without a '\r' at its end, or nothing if it was too long. Starts the next one.
  std::optional<std::string_view> cut_line();
  LineOutcome end_long_line();
  [[nodiscard]] bool starts_a_record() const;

  std::span<char> buffer_;
  std::size_t size_ = 0;  ///< may be one more than the buffer holds: then the line is too long
  LineReader lines_;
};

}  // namespace fencepost::record
