// The log that a run writes, parsed as it is written.
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>

#include "firmware/record/stream_reader.hpp"

namespace fencepost::host {

/// Splits the bytes of the log into lines, keeps the alerts and hands on the records that `replay --check` compares.
class OwnLog {
 public:
  /// Any of them may be missing.
  struct Listeners {
    std::function<void(std::string_view)> line{};  ///< each line, line end included
    std::function<void(const record::AlertReport&)> alert{};
    std::function<void(const record::ObjectReport&)> object{};
    std::function<void(const record::DigestReport&)> digest{};
    std::function<void(const record::Heartbeat&)> heartbeat{};
    std::function<void(const record::SpeedLimit&)> speed_limit{};
    std::function<void(const record::CalibrationDoubt&)> doubt{};  ///< again with each repetition of the calibration
  };

  explicit OwnLog(Listeners listeners) : listeners_(std::move(listeners)) {}

  void hear(std::string_view bytes) {
    while (!bytes.empty()) {
      const std::size_t size = std::min(bytes.find('\n'), bytes.size() - 1) + 1;
      const std::string_view part = bytes.substr(0, size);
      bytes.remove_prefix(size);
      if (line_.empty() && part.back() == '\n') {
        hear_line(part);
        continue;
      }
      line_ += part;
      if (part.back() != '\n') return;
      hear_line(line_);
      line_.clear();
    }
  }

  // The sink of the reader.
  void accept(const record::AlertReport& alert) { tell(listeners_.alert, alert); }
  void accept(const record::ObjectReport& object) { tell(listeners_.object, object); }
  void accept(const record::DigestReport& digest) { tell(listeners_.digest, digest); }
  void accept(const record::Heartbeat& beat) { tell(listeners_.heartbeat, beat); }
  void accept(const record::SpeedLimit& limit) { tell(listeners_.speed_limit, limit); }
  void accept(const record::CalibrationDoubt& doubt) { tell(listeners_.doubt, doubt); }
  template <class Record>
  void accept(const Record&) {}

 private:
  // The others, most of a log, are not even read.
  static bool is_told_of(std::string_view line) {
    using record::Kind;
    const auto is = [&](Kind kind) { return line.substr(1).starts_with(record::name(kind)); };
    return is(Kind::kHeartbeat) || is(Kind::kObject) || is(Kind::kAlert) || is(Kind::kDigest) ||
           is(Kind::kSpeedLimit) || is(Kind::kCalibrationDoubt);
  }
  void hear_line(std::string_view line) {
    std::string_view left = line;
    if (is_told_of(line)) reader_.take(left, *this);
    tell(listeners_.line, line);
  }
  template <class Heard>
  static void tell(const std::function<void(Heard)>& listener, std::type_identity_t<Heard> heard) {
    if (listener) listener(heard);
  }

  Listeners listeners_;
  std::string line_;
  std::array<char, record::StreamReader::kBuffer> buffer_{};
  record::StreamReader reader_{buffer_};
};

}  // namespace fencepost::host
