#include "drivers/cmucam/session.hpp"

#include <algorithm>

#include "drivers/cmucam/measure.hpp"
#include "drivers/serial/largest_first.hpp"

namespace fencepost::cmucam {
namespace {

/// Without a valid reply for this long the camera has lost its set-up.
constexpr base::Duration kTrackPatience = base::milliseconds(2'000);
/// Upper bound on the configured time to settle.
constexpr base::Duration kLongestSettle = base::milliseconds(60'000);
/// A command is sent this often before the session begins anew.
constexpr std::uint8_t kTries = 4;
/// Time-outs in a row after which the link is silent.
constexpr std::uint8_t kUnheardIsSilent = 3;

/// Ends ASCII input.
constexpr std::string_view kAsciiReset = "\rRS\r";
/// Ends raw input, in which another program may have left the camera. It may expect up to 13 more bytes: CRs supply
/// them. RS without arguments, in raw form, leaves the mode.
constexpr std::string_view kRawReset("\r\r\r\r\r\r\r\r\r\r\r\r\r\r\rRS\0", 18);

bool in_order(const ColourWindow& window) {
  return window.red_min <= window.red_max && window.green_min <= window.green_max && window.blue_min <= window.blue_max;
}

/// "TC r R g G b B". Bounds are clamped to what the imager gives: a saturated red is 255 to one camera, 240 to another.
class TrackCommand {
 public:
  TrackCommand(const ColourWindow& window, const Dialect& dialect) {
    for (const std::uint8_t bound :
         {window.red_min, window.red_max, window.green_min, window.green_max, window.blue_min, window.blue_max}) {
      put(std::clamp(bound, dialect.darkest, dialect.brightest));
    }
  }
  [[nodiscard]] std::string_view view() const { return text_.view(); }

 private:
  void put(std::uint8_t number) {
    append(' ');
    if (number >= 100) append(static_cast<char>('0' + number / 100));
    if (number >= 10) append(static_cast<char>('0' + number / 10 % 10));
    append(static_cast<char>('0' + number % 10));
  }
  void append(char c) { FENCEPOST_CHECK(text_.push_back(c)); }

  base::FixedString<26> text_{"TC"};
};

}  // namespace

Session::Session(const Config& config)
    : config_(config),
      usable_(!config.windows.empty() && std::all_of(config.windows.begin(), config.windows.end(), in_order)) {
  for (const std::string_view command : config.dialect->warm_up) FENCEPOST_CHECK(script_.push_back(command));
  FENCEPOST_CHECK(script_.push_back({}));
  for (const std::string_view command : config.dialect->set_up) FENCEPOST_CHECK(script_.push_back(command));
  if (config.raw && config.dialect->has_raw) FENCEPOST_CHECK(script_.push_back("RM 1"));
}

sensor::LinkState Session::link() const {
  if (silent_) return sensor::LinkState::kSilent;
  if (!seen_ || !usable_) return sensor::LinkState::kUnready;
  return frame_.blobs.empty() ? sensor::LinkState::kEmpty : sensor::LinkState::kOk;
}

void Session::link_lost() {
  phase_ = Phase::kOff;
  silent_ = true;
  seen_ = false;
  outbox_.clear();
}

void Session::step(base::Time now) {
  if (phase_ == Phase::kOff) {
    begin_reset(now);
  } else if (now >= deadline_) {
    time_out(now);
  }
}

bool Session::take(std::uint8_t byte, base::Time now) {
  const Event event = decoder_.feed(byte, now);
  if (event == Event::kNone || phase_ == Phase::kOff) return false;
  note_event(event);
  const bool unasked = phase_ == Phase::kCommand || phase_ == Phase::kSettle || phase_ == Phase::kTrack;
  // Or asked, but it had not answered for a while; that it is only its ACK that was lost is less likely then.
  const bool late = phase_ == Phase::kFlush && tries_ > 0;
  if (banner_ && !acked_ && (unasked || late)) {
    // The camera has just been switched on: its set-up is gone. A reset would start it anew, for two seconds.
    forget_set_up(now);
    flush(now);
    return false;
  }
  if (event != Event::kPrompt) return false;
  if (phase_ == Phase::kTrack && packet_ && decoder_.text().empty()) {
    const bool complete = end_question();
    ask(now);
    return complete;
  }
  end_exchange(now);
  return false;
}

void Session::note_event(Event event) {
  // A damaged line does not prove a camera: the baud rate may be wrong.
  if (event != Event::kText) {
    unheard_ = 0;
    silent_ = false;
  }
  switch (event) {
    case Event::kAck: acked_ = true; break;
    case Event::kNck: nacked_ = true; break;
    case Event::kPacket: packet_ = true; break;
    default: note_banner(event); break;
  }
}

void Session::note_banner(Event event) {
  const bool complete = event == Event::kText || event == Event::kPrompt;
  if (!complete || !decoder_.text().starts_with(config_.dialect->banner)) return;
  banner_ = true;
  silent_ = false;
  version_ = sensor::Text(decoder_.text());
}

// A prompt has come, but not right after a packet.
void Session::end_exchange(base::Time now) {
  switch (phase_) {
    case Phase::kReset:
      if (banner_) flush(now);
      break;
    case Phase::kFlush:
      if (banner_) {
        next_step(now);
      } else if (nacked_ && ++tries_ < kTries) {
        flush(now);
      }
      break;
    case Phase::kCommand:
      if (!acked_ && !nacked_) break;  // the prompt of an earlier command
      counts_.refused += acked_ ? 0U : 1U;
      if (acked_) {
        ++step_;
        tries_ = 0;
        last_good_ = now;
      } else if (++tries_ == kTries) {
        deadline_ = now + kTrackPatience;  // the command is refused: wait, then restart
        break;
      }
      next_step(now);
      break;
    case Phase::kTrack:
      if (banner_) {
        flush(now);  // an answer to an earlier GV; the answer to TC may still come
        break;
      }
      if (!acked_ && !nacked_) break;
      counts_.refused += nacked_ ? 1U : 0U;
      counts_.unanswered += nacked_ ? 0U : 1U;
      ask(now);
      break;
    case Phase::kOff:
    case Phase::kSettle: break;
  }
}

// True when the packet was the last of its frame.
bool Session::end_question() {
  const Packet& packet = decoder_.packet();
  const base::Result<sensor::Blob> blob = to_blob(packet, *config_.dialect, config_.windows[window_].signature);
  if (!blob && blob.error() == base::Error::kBadInput) {
    ++counts_.implausible;
    return false;
  }
  last_good_ = packet.t;
  tries_ = 0;
  if (window_ == 0) building_ = {packet.t, building_.frame + 1, {}};
  if (blob) (void)serial::insert_largest_first(building_, *blob);
  if (++window_ < config_.windows.size()) return false;
  window_ = 0;
  frame_ = building_;
  seen_ = true;
  ++counts_.frames;
  return true;
}

void Session::time_out(base::Time now) {
  if (phase_ != Phase::kSettle && unheard_ < kUnheardIsSilent && ++unheard_ == kUnheardIsSilent) silent_ = true;
  switch (phase_) {
    case Phase::kReset: send_reset(now); break;
    case Phase::kSettle:
      ++step_;
      next_step(now);
      break;
    case Phase::kTrack:
      ++counts_.unanswered;
      flush(now);
      break;
    case Phase::kFlush:
    case Phase::kCommand:
      if (++tries_ >= kTries) {
        begin_reset(now);
      } else {
        flush(now);
      }
      break;
    case Phase::kOff: break;
  }
}

void Session::begin_reset(base::Time now) {
  forget_set_up(now);
  phase_ = Phase::kReset;
  send_reset(now);
}

void Session::forget_set_up(base::Time now) {
  ++counts_.resets;
  tries_ = 0;
  step_ = 0;
  window_ = 0;
  seen_ = false;
  last_good_ = now;
}

void Session::send_reset(base::Time now) {
  outbox_.clear();
  // Every other time only: a camera in the right mode is spared the extra bytes.
  if (tries_++ % 2 == 1) FENCEPOST_CHECK(outbox_.put(kRawReset));
  FENCEPOST_CHECK(outbox_.put(kAsciiReset));
  acked_ = nacked_ = banner_ = packet_ = false;
  deadline_ = now + config_.dialect->reset_timeout;
}

// Asks for the version; the script continues after the reply.
void Session::flush(base::Time now) {
  if (phase_ == Phase::kReset) tries_ = 0;
  phase_ = Phase::kFlush;
  window_ = 0;
  // The first CR stops a stream and terminates a partial command.
  send("\rGV", now, config_.dialect->command_timeout);
}

void Session::next_step(base::Time now) {
  if (step_ == script_.size()) {
    ask(now);
    return;
  }
  if (script_[step_].empty()) {
    phase_ = Phase::kSettle;
    acked_ = banner_ = false;
    deadline_ = now + std::clamp(config_.settle, base::Duration{0}, kLongestSettle);
    return;
  }
  phase_ = Phase::kCommand;
  send(script_[step_], now, config_.dialect->command_timeout);
}

void Session::ask(base::Time now) {
  if (!usable_) {
    phase_ = Phase::kSettle;  // no window to ask for: check again later whether it is present
    step_ = 0;
    deadline_ = now + kTrackPatience;
    return;
  }
  if (now - last_good_ > kTrackPatience) {
    begin_reset(now);
    return;
  }
  phase_ = Phase::kTrack;
  const TrackCommand command(config_.windows[window_], *config_.dialect);
  send(command.view(), now, config_.dialect->reply_timeout);
}

void Session::send(std::string_view command, base::Time now, base::Duration timeout) {
  outbox_.clear();
  FENCEPOST_CHECK(outbox_.put(command));
  FENCEPOST_CHECK(outbox_.put("\r"));
  acked_ = nacked_ = banner_ = packet_ = false;
  deadline_ = now + timeout;
}

}  // namespace fencepost::cmucam
