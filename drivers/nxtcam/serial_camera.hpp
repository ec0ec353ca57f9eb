// An NXTCam v1 to v4, or an AVRcam, on a serial line (115200 baud).
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "drivers/nxtcam/serial.hpp"
#include "drivers/wire/flush.hpp"
#include "drivers/wire/receive.hpp"
#include "hal/base/fixed.hpp"
#include "hal/bus/byte_link.hpp"
#include "hal/sensor/link_state.hpp"
#include "hal/sensor/sources.hpp"

namespace fencepost::nxtcam {

/// Ping, version, tracking on; each is repeated until it is acknowledged. While tracking, a second without a packet
/// means that the camera was switched off: the sequence restarts. Whether colours were trained cannot be queried on
/// this link: an untrained camera is `empty`.
template <bus::ByteLink Link>
class SerialCamera {
 public:
  explicit SerialCamera(Link& link) : link_(link) {}

  base::Result<sensor::BlobFrame> poll(base::Time now) {
    receive(now);
    send(now);
    if (std::exchange(fresh_, false)) return frame_;
    return base::Error::kNotReady;
  }
  [[nodiscard]] sensor::LinkState link() const { return state_; }
  [[nodiscard]] std::uint32_t dropped() const { return 0; }  // eight objects fit
  /// Packets with a wrong end or an impossible object.
  [[nodiscard]] std::uint32_t damaged() const { return scanner_.damaged(); }
  /// Frames dropped because they arrived bunched with an earlier one: they were delayed on the way.
  [[nodiscard]] std::uint32_t stale() const { return stale_; }
  /// The line that follows the acknowledged version request.
  [[nodiscard]] std::string_view version() const { return version_.view(); }

 private:
  enum class Step : std::uint8_t { kPing, kVersion, kEnable, kTrack };
  static constexpr base::Duration kRetry = base::milliseconds(250);
  static constexpr base::Duration kQuiet = base::milliseconds(1'000);
  static constexpr int kReads = 8;

  void receive(base::Time now) {
    const bool found = wire::receive(link_, kReads, [&](std::span<const std::uint8_t> bytes) {
      for (const std::uint8_t byte : bytes) {
        scanner_.feed(byte, now, [&](std::span<const std::uint8_t> message, base::Time t) { take(message, t, now); });
      }
    });
    if (!found) lose(sensor::LinkState::kAbsent, now);
  }

  void take(std::span<const std::uint8_t> message, base::Time t, base::Time now) {
    if (std::optional<sensor::BlobFrame> frame = tracking_in(message)) {
      heard_ = now;
      step_ = Step::kTrack;
      state_ = frame->blobs.empty() ? sensor::LinkState::kEmpty : sensor::LinkState::kOk;
      if (last_ && t <= *last_) {
        ++stale_;
        return;
      }
      last_ = t;
      frame->t = t;
      frame->frame = count_++;
      frame_ = *frame;
      fresh_ = true;
    } else {
      take_line(line_in(message), now);
    }
  }

  void take_line(std::string_view line, base::Time now) {
    if (step_ == Step::kTrack) return;
    if (line == "ACK") {
      heard_ = now;
      acknowledged_ = true;
      state_ = std::max(state_, sensor::LinkState::kUnready);
      // The version's line comes behind its acknowledgement.
      if (step_ != Step::kVersion) advance(now);
    } else if (step_ == Step::kVersion && acknowledged_ && line != "NCK") {
      version_ = base::FixedString<32>(line);
      advance(now);
    }
  }

  void advance(base::Time now) {
    if (step_ == Step::kEnable) return;  // tracking packets say the rest
    step_ = step_ == Step::kPing ? Step::kVersion : Step::kEnable;
    acknowledged_ = false;
    next_ = now;
  }

  void send(base::Time now) {
    if (state_ > sensor::LinkState::kSilent && now - heard_ > kQuiet) lose(sensor::LinkState::kSilent, now);
    if (step_ != Step::kTrack && (!next_ || now >= *next_)) ask(now);
    if (!wire::flush(outbox_, link_)) lose(sensor::LinkState::kAbsent, now);
    if (outbox_.waiting().empty() && state_ == sensor::LinkState::kAbsent && sent_) state_ = sensor::LinkState::kSilent;
  }

  void ask(base::Time now) {
    next_ = now + kRetry;
    sent_ = true;
    const std::string_view text = step_ == Step::kPing      ? kPingLine
                                  : step_ == Step::kVersion ? kVersionLine
                                                            : kEnableLine;
    outbox_.clear();
    (void)outbox_.put(text);
  }

  void lose(sensor::LinkState state, base::Time now) {
    state_ = state;
    step_ = Step::kPing;
    acknowledged_ = false;
    sent_ = false;
    next_ = now + kRetry;
    scanner_.reset();
    outbox_.clear();
  }

  Link& link_;
  wire::Scanner<kLongestTracking, examine_avrcam> scanner_;
  serial::Outbox<4> outbox_;
  Step step_ = Step::kPing;
  sensor::LinkState state_ = sensor::LinkState::kSilent;
  bool acknowledged_ = false;
  bool sent_ = false;
  std::optional<base::Time> next_;
  base::Time heard_;
  std::uint32_t count_ = 0;
  std::uint32_t stale_ = 0;
  std::optional<base::Time> last_;
  base::FixedString<32> version_;
  sensor::BlobFrame frame_;
  bool fresh_ = false;  ///< frame_ was not taken yet
};

}  // namespace fencepost::nxtcam
