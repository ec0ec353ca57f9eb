#include "drivers/pixy2/session.hpp"

#include <algorithm>

namespace fencepost::pixy2 {
namespace {

using sensor::LinkState;

// The vendor's library waits 100 us on SPI. A line of 9600 baud needs 9 ms for a request, and one for the first byte
// back.
constexpr base::Duration kAnswerBegins = base::milliseconds(30);
// A request with a name, or padding, takes longer.
constexpr base::Duration kSetupAnswerBegins = base::milliseconds(150);
// Longest gap between bytes of a reply.
constexpr base::Duration kAnswerGoesOn = base::milliseconds(20);
// The longest packet at 9600 baud takes 272 ms.
constexpr base::Duration kAnswerEnds = base::milliseconds(400);
// A frame lasts 16 ms: pause for half of it, then poll four times as often.
constexpr base::Duration kFramePause = base::milliseconds(8);
// Pause after the answer that no new frame is ready.
constexpr base::Duration kBusyPause = base::milliseconds(4);
// Pause before the set-up is tried again.
constexpr base::Duration kSetupPause = base::milliseconds(100);
// Pause between requests to a silent camera.
constexpr base::Duration kSilentPause = base::milliseconds(250);
// Without a new frame for this long it is not working, whatever it reports.
constexpr base::Duration kFrameOverdue = base::milliseconds(1'000);
// Time-outs in a row after which it is silent.
constexpr std::uint8_t kMissesToSilence = 3;

}  // namespace

Request Session::request() const {
  switch (step_) {
    case Step::kVersion: return request_version();
    case Step::kProgram: return request_program();
    case Step::kResolution: return request_resolution();
    case Step::kBlocks: break;
  }
  return request_blocks(options_.signatures);
}

std::optional<Request> Session::due(base::Time now) {
  if (waiting_ && now >= deadline_) expire(now);
  if (waiting_ || (next_ && now < *next_)) return std::nullopt;
  waiting_ = true;
  asked_ = now;
  const bool quick = step_ == Step::kBlocks && missed_ == 0;
  deadline_ = now + (quick ? kAnswerBegins : kSetupAnswerBegins);
  return missed_ == 0 ? request() : behind_padding(request());
}

void Session::extend(base::Time now) {
  if (waiting_) deadline_ = std::min(std::max(deadline_, now + kAnswerGoesOn), asked_ + kAnswerEnds);
}

void Session::expire(base::Time now) {
  ++counters_.timeouts;
  missed_ = static_cast<std::uint8_t>(std::min(missed_ + 1, int{kMissesToSilence}));
  ask_after({}, now);
  if (missed_ < kMissesToSilence) return;
  if (heard_) restart();
  heard_ = false;
  ask_after(kSilentPause, now);
}

// On a line that brings nothing else no request is ever missed: asking again begins a new wait.
void Session::take_damage(base::Time now) {
  if (step_ == Step::kBlocks && now - last_frame_ > kFrameOverdue) work_ = LinkState::kUnready;
  if (waiting_) ask_after({}, now);
}

void Session::lose_link(base::Time now) {
  if (!absent_) restart();
  absent_ = true;
  heard_ = false;
  ask_after(kSilentPause, now);
}

void Session::restart() {
  ++counters_.restarts;
  step_ = Step::kVersion;
  work_ = LinkState::kUnready;
}

void Session::ask_after(base::Duration pause, base::Time now) {
  waiting_ = false;
  next_ = now + pause;
}

void Session::take(const Packet& packet, base::Time first_byte, base::Time now) {
  if (!waiting_ || !take_answer(packet, first_byte, now)) {
    ++counters_.malformed;
    return;
  }
  heard_ = true;
  missed_ = 0;
  ask_after(pause_, now);
}

bool Session::take_answer(const Packet& packet, base::Time first_byte, base::Time now) {
  pause_ = {};
  if (const std::optional<DeviceError> error = error_in(packet)) {
    take_error(*error, now);
    return true;
  }
  switch (step_) {
    case Step::kVersion: return take_version(packet);
    case Step::kProgram: return take_result(packet);
    case Step::kResolution: last_frame_ = now; return take_resolution(packet);
    case Step::kBlocks: break;
  }
  return take_blocks(packet, first_byte);
}

bool Session::take_version(const Packet& packet) {
  const std::optional<Version> version = version_in(packet);
  if (!version) return false;
  version_ = version;
  step_ = options_.select_program ? Step::kProgram : Step::kResolution;
  return true;
}

// 1: it runs; 0: it will.
bool Session::take_result(const Packet& packet) {
  const std::optional<std::int32_t> result = result_in(packet);
  if (!result) return false;
  if (*result > 0) {
    step_ = Step::kResolution;
  } else {
    pause_ = kSetupPause;
  }
  return true;
}

bool Session::take_resolution(const Packet& packet) {
  const std::optional<Resolution> resolution = resolution_in(packet);
  if (!resolution) return false;
  if (*resolution == kBlobResolution) {
    step_ = Step::kBlocks;
  } else {
    restart();
    pause_ = kSetupPause;
  }
  return true;
}

bool Session::take_blocks(const Packet& packet, base::Time first_byte) {
  std::optional<Blocks> blocks = blocks_in(packet);
  if (!blocks) return false;
  sensor::BlobFrame& frame = blocks->frame;
  frame.t = first_byte;
  frame.frame = counters_.frames++;
  counters_.blobs_dropped += blocks->dropped;
  work_ = frame.blobs.empty() ? LinkState::kEmpty : LinkState::kOk;
  last_frame_ = first_byte;
  frame_ = frame;
  fresh_ = true;
  pause_ = kFramePause;
  return true;
}

void Session::take_error(DeviceError error, base::Time now) {
  if (step_ == Step::kBlocks && error == DeviceError::kBusy) {
    if (now - last_frame_ > kFrameOverdue) work_ = LinkState::kUnready;
    pause_ = kBusyPause;
    return;
  }
  work_ = LinkState::kUnready;
  pause_ = kSetupPause;
  const bool passes =
      error == DeviceError::kBusy || error == DeviceError::kButton || error == DeviceError::kProgramChanging;
  if (passes || options_.signatures == 0) return;
  // Firmware that cannot change programs has only one.
  if (step_ == Step::kProgram && error == DeviceError::kUnsupported) {
    step_ = Step::kResolution;
  } else {
    restart();
  }
}

LinkState Session::link() const {
  if (absent_) return LinkState::kAbsent;
  return heard_ ? work_ : LinkState::kSilent;
}

}  // namespace fencepost::pixy2
