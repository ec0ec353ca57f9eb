#include "drivers/create/session.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "hal/base/check.hpp"

namespace fencepost::create {
namespace {

// Opcodes sent per attempt to fill up a packet list: one with a damaged count swallows up to 255 bytes.
constexpr std::size_t kPadding = 32;
// Attempts without padding.
constexpr std::uint8_t kTriesToPadding = 2;

/// 33 frames.
constexpr base::Duration kPatience = base::milliseconds(500);
/// A command may be damaged on its way, and nothing acknowledges it.
constexpr base::Duration kSteerAgain = base::milliseconds(100);
/// No robot restarts faster.
constexpr base::Duration kShortestStart = base::milliseconds(1'000);

constexpr std::uint8_t kStart = 0x80;  // opcodes of the Open Interface
constexpr std::uint8_t kSafe = 0x83;
constexpr std::uint8_t kFull = 0x84;
constexpr std::uint8_t kDrive = 0x89;
constexpr std::uint8_t kStream = 0x94;

/// Of a Create 1: after a longer gap a frame was lost.
constexpr base::Duration kFrameAndHalf = base::milliseconds(25);
/// Of a Create 1: a request for a reading is repeated after this time without one.
constexpr base::Duration kAskAgain = base::milliseconds(100);

using PacketIds = base::FixedVector<std::uint8_t, kMaxFields>;

PacketIds packets(Model model, bool reading) {
  constexpr std::array<std::uint8_t, 2> kEncoders = {43, 44};               // left, right
  constexpr std::array<std::uint8_t, 4> kReadRequested = {19, 20, 42, 41};  // distance, angle, left, right
  PacketIds ids;
  std::span<const std::uint8_t> wanted = kEncoders;
  if (model == Model::kCreate1) wanted = std::span(kReadRequested).subspan(reading ? 0 : 2);
  for (const std::uint8_t id : wanted) FENCEPOST_CHECK(ids.push_back(id));
  return ids;
}

StreamLayout layout_of(Model model, bool reading) {
  StreamLayout layout;
  for (const std::uint8_t id : packets(model, reading)) {
    const StreamField field{id, 2};
    FENCEPOST_CHECK(layout.push_back(field));
  }
  return layout;
}

// On the spot its middle has no speed.
Motion slowed(Motion motion, std::int16_t most) {
  const bool on_the_spot = motion.radius_mm == Motion::kOnTheSpotLeft || motion.radius_mm == Motion::kOnTheSpotRight;
  if (!on_the_spot) motion.velocity_mm_s = std::clamp<std::int16_t>(motion.velocity_mm_s, -most, most);
  return motion;
}

}  // namespace

Session::Session(const Config& config)
    : config_(config),
      decoder_(layout_of(config.model, false)),
      wheels_(config.wheels),
      reading_decoder_(layout_of(config.model, true)),
      requested_(config.wheels.track_pm) {}

bool Session::take(std::uint8_t byte, base::Time now) {
  heard_ = true;
  heard_at_ = now;
  if (!take_frame(byte, now)) return false;
  any_ = true;
  streaming_ = true;
  tries_ = 0;
  deadline_ = now + kPatience;
  ++counts_.frames;
  return true;
}

bool Session::take_frame(std::uint8_t byte, base::Time now) {
  if (config_.model == Model::kCreate1) {
    const bool reading = reading_decoder_.feed(byte, now);
    return (decoder_.feed(byte, now) || reading) && take_requested(reading);
  }
  if (!decoder_.feed(byte, now) || (any_ && decoder_.t() < last_t_)) return false;
  take_counts();
  last_t_ = decoder_.t();
  return true;
}

void Session::take_counts() {
  const std::uint16_t left = decoder_.value(0);
  const std::uint16_t right = decoder_.value(1);
  const base::Time t = decoder_.t();
  if (any_ && t == last_t_) return;  // the next frame's counts include this motion
  if (any_ && may_have_restarted(t - last_t_)) wheels_.forget_counts();
  sample_ = wheels_.take(left, right, t);
  counts_.impossible = wheels_.resets();
}

bool Session::may_have_restarted(base::Duration silence) const {
  if (silence < kShortestStart) return false;
  const std::int64_t way = furthest_mm(silence) * odometry::kPicometresPerMillimetre;
  const auto near_zero = [&](std::uint16_t raw, std::int64_t per_count) {
    const std::int64_t pm = static_cast<std::int16_t>(raw) * per_count;
    return pm <= way && pm >= -way;
  };
  return near_zero(decoder_.value(0), config_.wheels.left_pm_per_count) &&
         near_zero(decoder_.value(1), config_.wheels.right_pm_per_count);
}

// One more millimetre and a tenth of a second allow for the robot's rounding and for late frames.
std::int64_t Session::furthest_mm(base::Duration time) const {
  constexpr base::Duration kLateness = base::milliseconds(100);
  return config_.wheels.max_speed_mm_s * (time + kLateness).raw / base::Duration::kPerUnit + 1;
}

// The first reading covers an unknown time.
bool Session::take_requested(bool reading) {
  const StreamDecoder& decoder = reading ? reading_decoder_ : decoder_;
  const base::Time t = decoder.t();
  const auto value = [&](std::size_t field) { return static_cast<std::int16_t>(decoder.value(field)); };
  if (any_ && t < last_t_) return false;
  if (!any_ && !reading) return false;
  // A frame that was lost may have been a reading; a robot that was switched off forgot.
  const bool in_part = t - last_t_ > kFrameAndHalf;
  requested_.request(value(reading ? 2 : 0), value(reading ? 3 : 1), t);
  last_t_ = t;
  if (reading) {
    const std::int64_t furthest = furthest_mm(t - read_at_);
    const bool possible = value(0) <= furthest && value(0) >= -furthest;
    if (any_ && !possible) ++counts_.impossible;
    if (any_ && possible) {
      requested_.read({value(0), value(1), in_part});
    } else {
      requested_.skip_reading();
    }
    read_at_ = t;
    reading_due_ = t + requested_.interval();
    (void)request_packets(false);
  }
  sample_ = requested_.sample(t);
  return true;
}

bool Session::request_packets(bool reading) {
  base::FixedVector<std::uint8_t, 2 + kMaxFields> bytes;
  const PacketIds ids = packets(config_.model, reading);
  FENCEPOST_CHECK(bytes.push_back(kStream));
  FENCEPOST_CHECK(bytes.push_back(static_cast<std::uint8_t>(ids.size())));
  for (const std::uint8_t id : ids) FENCEPOST_CHECK(bytes.push_back(id));
  return outbox_.put(bytes.view());
}

void Session::ask_for_reading(base::Time now) {
  if (config_.model != Model::kCreate1 || !streaming_) return;
  if (now < reading_due_ || now - asked_at_ < kAskAgain) return;
  if (request_packets(true)) asked_at_ = now;
}

void Session::step(base::Time now) {
  if (now - heard_at_ > kPatience) heard_ = false;
  ask_if_due(now);
  ask_for_reading(now);
  steer(now);
}

void Session::ask_if_due(base::Time now) {
  if (begun_ && now < deadline_) return;
  if (begun_ && streaming_) {
    decoder_.forget_rule();
    reading_decoder_.forget_rule();
  }
  streaming_ = false;
  ask_for_stream(now);
}

// A stopped stream is first only requested again: Start would take the robot out of the mode in which it is being
// driven.
void Session::ask_for_stream(base::Time now) {
  const bool whole = !begun_ || tries_ % 2 == 1;
  ++tries_;
  begun_ = true;
  deadline_ = now + kPatience;
  ++counts_.starts;
  base::FixedVector<std::uint8_t, 2 + kPadding> bytes;
  const auto put = [&](std::uint8_t byte) { FENCEPOST_CHECK(bytes.push_back(byte)); };
  // A robot that took damaged bytes for the start of a long command waits for the remainder and swallows our request.
  for (std::size_t i = 0; whole && tries_ > kTriesToPadding && i < kPadding; ++i) put(kStart);
  if (whole) put(kStart);
  if (whole && config_.mode != Mode::kPassive) put(config_.mode == Mode::kSafe ? kSafe : kFull);
  // No room: the line is blocked; the next step retries.
  if (outbox_.put(bytes.view()) && request_packets(true)) asked_at_ = now;
}

// A robot whose wheels are not heard of is not driven on.
void Session::steer(base::Time now) {
  if (!motion_) return;
  const Motion wanted = allowed_ && streaming_ ? slowed(*motion_, most_) : Motion{};
  if (steered_ == wanted && now - steered_at_ < kSteerAgain) return;
  if (!put(wanted)) return;
  steered_ = wanted;
  steered_at_ = now;
}

bool Session::put(const Motion& motion) {
  const auto high = [](std::int16_t value) {
    return static_cast<std::uint8_t>(static_cast<std::uint16_t>(value) >> 8U);
  };
  const auto low = [](std::int16_t value) { return static_cast<std::uint8_t>(value & 0xFF); };
  const std::array<std::uint8_t, 5> bytes = {kDrive, high(motion.velocity_mm_s), low(motion.velocity_mm_s),
                                             high(motion.radius_mm), low(motion.radius_mm)};
  return outbox_.put(bytes);
}

void Session::stand() {
  if (!motion_) return;
  motion_.reset();
  (void)put({});
  (void)outbox_.put(std::array{kStart});
}

void Session::link_lost() {
  decoder_.reset();
  reading_decoder_.reset();
  steered_.reset();
  begun_ = streaming_ = heard_ = false;
  tries_ = 0;
  outbox_.clear();
}

sensor::LinkState Session::link() const {
  if (!heard_) return sensor::LinkState::kSilent;
  return streaming_ ? sensor::LinkState::kOk : sensor::LinkState::kUnready;
}

}  // namespace fencepost::create
