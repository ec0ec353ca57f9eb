#include "drivers/nxtcam/v5_session.hpp"

#include <array>

#include "drivers/serial/largest_first.hpp"

namespace fencepost::nxtcam {
namespace {

using sensor::LinkState;

constexpr base::Duration kAskPeriod = base::milliseconds(1'000);
// Shorter than the camera's frame period: a blob with the same count so soon belongs to the same image.
constexpr base::Duration kSameImage = base::milliseconds(20);
constexpr std::size_t kHeader = 4;  // bytes before a message's data
constexpr std::uint8_t kVersionType = 1;
constexpr std::array<std::uint8_t, 5> kAskVersion = {0x55, 0xAA, 0x00, 0x01, 0x00};       // the last is the checksum
constexpr std::array<std::uint8_t, 6> kTrackingOn = {0x55, 0xAA, 0x01, 0x03, 'E', 0x48};  // the same

}  // namespace

void V5Session::take(std::uint8_t byte, base::Time now) {
  ++unexplained_;
  byte_at_ = now;
  scanner_.feed(byte, now, [&](std::span<const std::uint8_t> message, base::Time first_byte) {
    unexplained_ -= static_cast<std::uint32_t>(message.size());
    take_message(message, first_byte, now);
  });
  // The damaged frame may have been a blob: nothing is concluded about what the camera sees.
  if (unexplained_ == scanner_.pending().size()) return;
  unexplained_ = static_cast<std::uint32_t>(scanner_.pending().size());
  quiet_since_.reset();
}

void V5Session::take_message(std::span<const std::uint8_t> message, base::Time first_byte, base::Time now) {
  constexpr std::uint8_t kBlobType = 4;
  if (!found_) {
    found_ = now;
    blob_at_ = now;
    asked_once_ = false;  // tracking on, now that it listens
  }
  heard_ = now;
  if (!quiet_since_) quiet_since_ = now;
  if (const std::optional<V5Blob> blob = v5_blob_in(message)) {
    take_blob(*blob, first_byte, now);
  } else if (message[3] == kBlobType) {
    ++counts_.rejected;
  } else if (message[3] == kVersionType) {
    take_version(message);
  } else {
    ++counts_.unrelated;
  }
}

void V5Session::take_blob(const V5Blob& blob, base::Time first_byte, base::Time now) {
  if (building_ && blob.frame != number_) finish(now);
  if (!building_) {
    if (given_ && seen_ && blob.frame == number_ && first_byte - blob_at_ < kSameImage) {
      ++counts_.late;
      return;
    }
    building_ = true;
    number_ = blob.frame;
    frame_ = {};
    frame_.t = first_byte;
  }
  blob_at_ = now;
  quiet_since_.reset();
  if (!serial::insert_largest_first(frame_, blob.blob)) ++counts_.blobs_dropped;
}

void V5Session::take_version(std::span<const std::uint8_t> message) {
  version_ = {};
  for (const std::uint8_t byte : message.subspan(kHeader, message[2])) {
    if (byte < ' ' || byte > '~' || !version_.push_back(static_cast<char>(byte))) break;
  }
}

// A frame that arrived bunched with the one before was delayed on the way.
void V5Session::finish(base::Time now) {
  building_ = false;
  if (last_t_ && frame_.t <= *last_t_) {
    ++counts_.stale;
    return;
  }
  last_t_ = frame_.t;
  given_ = true;
  seen_ = !frame_.blobs.empty();
  blob_at_ = now;
  frame_.frame = counts_.frames++;
  counts_.stale += fresh_ ? 1U : 0U;
  complete_ = frame_;
  fresh_ = true;
}

void V5Session::step(base::Time now) {
  // The remainder of a truncated frame never arrives; waiting for it would swallow the next one.
  if (now - byte_at_ > kSameImage) forget_bytes();
  if (building_ && now - byte_at_ >= options_.frame_pause) finish(now);
  if (found_ && !options_.silence_is_empty && now - heard_ > options_.timeout) {
    found_.reset();
    given_ = building_ = false;
    forget_bytes();
  }
  if (options_.ask) ask(now);
  if (found_ && !building_) give_empty(now);
}

void V5Session::ask(base::Time now) {
  const bool sees_nothing = found_ && (!seen_ || now - blob_at_ >= options_.empty_period);
  const base::Duration period = sees_nothing ? options_.empty_period : kAskPeriod;
  if (absent_ || (asked_once_ && now - asked_ < period)) return;
  asked_ = now;
  asked_once_ = true;
  // Bytes that a dead line did not take are of no use later.
  outbox_.clear();
  // A camera that was switched off and on between two answers does not track: the command is repeated while it sees
  // nothing.
  if (sees_nothing) (void)outbox_.put(kTrackingOn);
  (void)outbox_.put(kAskVersion);
}

void V5Session::give_empty(base::Time now) {
  if (options_.silence_is_empty && !quiet_since_) quiet_since_ = now;
  const bool quiet = quiet_since_ && now - *quiet_since_ >= options_.empty_period;
  if (!quiet || now - *found_ < options_.start_up || now - blob_at_ < options_.empty_period) return;
  // A stalled line gives no information about what the camera sees.
  if (!options_.silence_is_empty && heard_ <= blob_at_) return;
  frame_ = {};
  frame_.t = now;
  finish(now);
}

void V5Session::lose_link() {
  absent_ = true;
  found_.reset();
  given_ = building_ = seen_ = asked_once_ = false;
  forget_bytes();
  outbox_.clear();
}

void V5Session::forget_bytes() {
  scanner_.reset();
  unexplained_ = 0;
}

LinkState V5Session::link() const {
  if (absent_) return LinkState::kAbsent;
  if (!found_) return LinkState::kSilent;
  if (!given_) return LinkState::kUnready;
  return seen_ ? LinkState::kOk : LinkState::kEmpty;
}

}  // namespace fencepost::nxtcam
