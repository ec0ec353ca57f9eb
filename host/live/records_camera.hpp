// A camera whose own program sends $FPFRM lines over a port of its own.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "firmware/record/decode.hpp"
#include "hal/base/units.hpp"
#include "hal/sensor/blob_frame.hpp"
#include "hal/sensor/link_state.hpp"

namespace fencepost::host {

struct FramesConfig {};

/// A session for serial::Pump. A frame's t is when the first byte of its line arrived, whatever time it bears. Lines of
/// other kinds are passed over.
class FramesSession {
 public:
  using Sample = sensor::BlobFrame;

  /// No outbox: nothing is ever sent.
  struct Silence {
    [[nodiscard]] static std::span<const std::uint8_t> waiting() { return {}; }
    static void sent(std::size_t /*count*/) {}
  };

  explicit FramesSession(const FramesConfig& /*config*/) {}

  bool take(std::uint8_t byte, base::Time now) {
    any_byte_ = now;
    complete_ = false;
    if (byte == '\n' || byte == '\r') {
      static_cast<void>(record::decode(line_, {}, *this));
      line_.clear();
    } else if (line_.size() < record::kMaxLine) {
      // A piece of a line before the `$`, cut off by an unplug or a start of the program, is dropped.
      if (byte == '$') line_.clear();
      if (line_.empty()) began_ = now;
      line_ += static_cast<char>(byte);
    }
    return complete_;
  }
  [[nodiscard]] const sensor::BlobFrame& sample() const { return sample_; }
  void step(base::Time now) { now_ = now; }
  void link_lost() {
    line_.clear();
    heard_.reset();
    any_byte_.reset();
  }
  static Silence& outbox() {
    static Silence silence;
    return silence;
  }

  /// unready: bytes come, but no good frame within the last second.
  [[nodiscard]] sensor::LinkState link() const {
    if (heard_ && now_ - *heard_ < kQuiet) {
      return sample_.blobs.empty() ? sensor::LinkState::kEmpty : sensor::LinkState::kOk;
    }
    return any_byte_ && now_ - *any_byte_ < kQuiet ? sensor::LinkState::kUnready : sensor::LinkState::kSilent;
  }

  /// Its program sends the largest 16 and no count of the others.
  [[nodiscard]] static std::uint32_t dropped() { return 0; }

  // The sink of the decoder.
  void accept(const sensor::BlobFrame& frame) {
    sample_ = frame;
    sample_.t = began_;
    heard_ = any_byte_;
    complete_ = true;
  }
  template <class Record>
  void accept(const Record& /*record*/) {}

 private:
  static constexpr base::Duration kQuiet = base::milliseconds(1'000);

  std::string line_;
  sensor::BlobFrame sample_;
  bool complete_ = false;
  base::Time began_;
  base::Time now_;
  std::optional<base::Time> heard_;
  std::optional<base::Time> any_byte_;
};

}  // namespace fencepost::host
