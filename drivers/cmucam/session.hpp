// The protocol state machine of a CMUcam: reset, version, set-up, then one packet per request.
#pragma once

#include <cstdint>
#include <string_view>

#include "drivers/cmucam/config.hpp"
#include "drivers/cmucam/decoder.hpp"
#include "drivers/serial/outbox.hpp"
#include "hal/base/fixed.hpp"
#include "hal/sensor/blob_frame.hpp"
#include "hal/sensor/camera.hpp"
#include "hal/sensor/link_state.hpp"

namespace fencepost::cmucam {

/// Counts since start-up; none of these stops the session.
struct Counts {
  std::uint32_t frames = 0;
  std::uint32_t implausible = 0;  ///< packets that cannot be a box of this camera: dropped, requested again
  std::uint32_t unanswered = 0;   ///< requests without a packet: damaged on the line, or lost
  std::uint32_t refused = 0;      ///< NCK: a command damaged on the line, or unknown to the camera
  std::uint32_t resets = 0;       ///< times the set-up was begun, the first included
};

/// Polls (PM 1): an answer is a packet *and* the prompt after it, which catches most damage on a line without
/// checksums. ACK stays on (RM 1, not 3), so a NCK costs no time-out. Commands go out in ASCII only. In raw input mode
/// a CMUcam1 reads a text's CR as a count of bytes, and a CMUcam3 turns arguments 97..122 into 65..90. After a time-out
/// the version is requested: replies come in order, so a late one cannot be taken for the next reply. Every wait is
/// bounded; after any failure the session returns to the reset.
/// Our sources are uncertain about the order of CR, ACK and version text after RS, and about a CR after GV's text. They
/// are also uncertain which of the packets C, M, T or N comes. Every variant is accepted.
class Session {
 public:
  using Sample = sensor::BlobFrame;

  explicit Session(const Config& config);

  /// True: a frame is complete.
  bool take(std::uint8_t byte, base::Time now);
  [[nodiscard]] const sensor::BlobFrame& sample() const { return frame_; }
  void step(base::Time now);
  void link_lost();
  auto& outbox() { return outbox_; }

  /// kUnready until the first frame, and always without a colour window or with one whose bounds are swapped.
  [[nodiscard]] sensor::LinkState link() const;
  /// The camera finds one box a colour: nothing is ever dropped.
  [[nodiscard]] static std::uint32_t dropped() { return 0; }
  [[nodiscard]] const Counts& counts() const { return counts_; }
  /// The camera's own words, such as "CMUcam v1.12"; empty until it has said so.
  [[nodiscard]] std::string_view version() const { return version_.view(); }

 private:
  enum class Phase : std::uint8_t {
    kOff,      ///< not begun, or the link is gone
    kReset,    ///< RS is out, the version text has to come
    kFlush,    ///< GV is out, after a reset or a time-out
    kCommand,  ///< a command of the set-up is out
    kSettle,   ///< white balance and gain find their values
    kTrack,    ///< TC is out
  };

  void note_event(Event event);
  void note_banner(Event event);
  void end_exchange(base::Time now);
  bool end_question();
  void time_out(base::Time now);

  void begin_reset(base::Time now);
  void forget_set_up(base::Time now);
  void send_reset(base::Time now);
  void flush(base::Time now);
  void next_step(base::Time now);
  void ask(base::Time now);
  void send(std::string_view command, base::Time now, base::Duration timeout);

  const Config config_;
  bool usable_;
  /// The commands of the set-up in order; an empty one is the time to settle.
  base::FixedVector<std::string_view, 8> script_;
  Decoder decoder_;
  serial::Outbox<64> outbox_;

  Phase phase_ = Phase::kOff;
  std::uint8_t step_ = 0;
  std::uint8_t tries_ = 0;
  bool acked_ = false;
  bool nacked_ = false;
  bool banner_ = false;
  bool packet_ = false;
  base::Time deadline_;
  base::Time last_good_;

  std::uint8_t window_ = 0;
  sensor::BlobFrame building_;
  sensor::BlobFrame frame_;
  std::uint8_t unheard_ = 0;  ///< time-outs since the last valid reply
  bool silent_ = true;
  bool seen_ = false;
  sensor::Text version_;
  Counts counts_;
};

}  // namespace fencepost::cmucam
