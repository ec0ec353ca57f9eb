// A log in portions, as `replay` reads it: of a file, a pipe or standard input, unpacked if gzip packed it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "host/text/gunzip.hpp"

namespace fencepost::host::cli {

class LogInput {
 public:
  /// "-" is standard input. errors: Failure (kUnreadable): missing, not allowed
  explicit LogInput(std::string path);
  LogInput(const LogInput&) = delete;
  LogInput& operator=(const LogInput&) = delete;
  ~LogInput();

  /// The bytes that follow, which hold until the next call; none at the end. errors: Failure (kUnreadable): a folder,
  /// read error, damaged packing, UTF-16
  std::string_view next();

  /// Size of the file as stored; nothing of a pipe or a terminal.
  [[nodiscard]] std::optional<std::uint64_t> size() const { return size_; }
  /// Whether gzip packed it; known after the first `next`.
  [[nodiscard]] bool packed() const { return gunzip_ != nullptr; }
  /// Bytes read so far.
  [[nodiscard]] std::uint64_t position() const { return position_; }

 private:
  std::string_view read();
  std::string_view unpacked();

  std::string path_;
  int file_ = -1;
  std::optional<std::uint64_t> size_;
  std::uint64_t position_ = 0;
  bool begun_ = false;
  std::string chunk_;
  std::unique_ptr<Gunzip> gunzip_;
};

/// A log for commands that look at all of it at once, at most kMaxWhole. Of a line that is longer than any record the
/// beginning alone, which is counted as the whole would be. errors: Failure (kUnreadable): as LogInput, and
/// one that is longer
std::string read_log(const std::string& path);
/// The same for a file that may be a scene: no line is cut.
std::string read_log_or_scene(const std::string& path);
/// Before work begins on a log that is read as a whole. Of a pipe nothing is known. errors: as read_log
void expect_whole_log(const std::string& path);
[[noreturn]] void refuse_long_log(const std::string& path);
/// The end of a sentence about a log that is too long.
std::string how_to_make_a_part(const std::string& path);

}  // namespace fencepost::host::cli
