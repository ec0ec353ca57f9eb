// The log that a run writes, parsed as it is written.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "firmware/record/stream_reader.hpp"

namespace fencepost::host {

/// Splits the bytes of the log into lines, keeps the alerts and hands on what `replay --check` compares.
class OwnLog {
 public:
  /// Any of them may be missing.
  struct Listeners {
    std::function<void(std::string_view)> line{};  ///< each line, line end included
    std::function<void(const record::AlertReport&)> alert{};
    std::function<void(const record::ObjectReport&)> object{};
    std::function<void(const record::DigestReport&)> digest{};
    std::function<void(const record::Heartbeat&)> heartbeat{};
    std::function<void(const record::CalibrationDoubt&)> doubt{};  ///< again with each repetition of the calibration
  };

  explicit OwnLog(Listeners listeners) : listeners_(std::move(listeners)) {}

  void hear(std::string_view bytes) {
    for (const char byte : bytes) {
      line_.push_back(byte);
      reader_.push(byte, *this);
      if (byte != '\n') continue;
      tell(listeners_.line, line_);
      line_.clear();
    }
  }

  // The sink of the reader.
  void accept(const record::AlertReport& alert) { tell(listeners_.alert, alert); }
  void accept(const record::ObjectReport& object) { tell(listeners_.object, object); }
  void accept(const record::DigestReport& digest) { tell(listeners_.digest, digest); }
  void accept(const record::Heartbeat& beat) { tell(listeners_.heartbeat, beat); }
  void accept(const record::CalibrationDoubt& doubt) { tell(listeners_.doubt, doubt); }
  template <class Record>
  void accept(const Record&) {}

 private:
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
