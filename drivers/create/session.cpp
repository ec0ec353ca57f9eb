#include "drivers/create/session.hpp"

#include <array>

#include "hal/base/trig.hpp"

namespace fencepost::create {
namespace {

// A packet list with a damaged count swallows up to 255 bytes; this many are sent per attempt.
constexpr std::size_t kPadding = 32;
constexpr std::uint8_t kTriesToPadding = 2;

/// 33 frames.
constexpr base::Duration kPatience = base::milliseconds(500);
/// A command may be damaged on its way, and nothing acknowledges it.
constexpr base::Duration kSteerAgain = base::milliseconds(100);
/// No robot restarts faster.
constexpr base::Duration kShortestStart = base::milliseconds(1'000);

// Opcodes of the Open Interface.
constexpr std::uint8_t kStart = 0x80;
constexpr std::uint8_t kSafe = 0x83;
constexpr std::uint8_t kFull = 0x84;
constexpr std::uint8_t kDrive = 0x89;
constexpr std::uint8_t kStream = 0x94;

StreamLayout layout_of(Model model) {
  constexpr StreamField kDistance{19, 2};
  constexpr StreamField kAngle{20, 2};
  constexpr StreamField kLeftEncoder{43, 2};
  constexpr StreamField kRightEncoder{44, 2};
  StreamLayout layout;
  const bool first = model == Model::kCreate1;
  const bool stored =
      layout.push_back(first ? kDistance : kLeftEncoder) && layout.push_back(first ? kAngle : kRightEncoder);
  FENCEPOST_CHECK(stored);
  return layout;
}

}  // namespace

Session::Session(const Config& config) : config_(config), decoder_(layout_of(config.model)), wheels_(config.wheels) {}

bool Session::take(std::uint8_t byte, base::Time now) {
  heard_ = true;
  heard_at_ = now;
  if (!decoder_.feed(byte, now)) return false;
  const base::Time t = decoder_.t();
  // Several frames bunched together: the first one's time is used for all, and a Create 1's motions still add up.
  if (any_ && t < last_t_) return false;
  config_.model == Model::kCreate1 ? take_distance() : take_counts();
  last_t_ = t;
  any_ = true;
  streaming_ = true;
  tries_ = 0;
  deadline_ = now + kPatience;
  ++counts_.frames;
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

void Session::take_distance() {
  const std::int64_t mm = static_cast<std::int16_t>(decoder_.value(0));
  const std::int64_t degrees = static_cast<std::int16_t>(decoder_.value(1));
  const base::Time t = decoder_.t();
  if (any_) {  // the first reading covers an unknown time
    const std::int64_t furthest = furthest_mm(t - last_t_);
    if (mm > furthest || mm < -furthest) {
      ++counts_.impossible;
    } else {
      degrees_ += degrees;
      const std::int64_t heading = odometry::divide_nearest(degrees_ * (base::kTwoPiPicoradians / 360), 1'000'000);
      pose_.advance(mm * odometry::kPicometresPerMillimetre, heading);
    }
  }
  sample_ = pose_.sample(t);
}

void Session::step(base::Time now) {
  if (now - heard_at_ > kPatience) heard_ = false;
  ask_if_due(now);
  steer(now);
}

void Session::ask_if_due(base::Time now) {
  if (begun_ && now < deadline_) return;
  if (begun_ && streaming_) decoder_.forget_rule();
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
  base::FixedVector<std::uint8_t, 8 + kPadding> bytes;
  bool stored = true;
  const auto put = [&](std::uint8_t byte) { stored = bytes.push_back(byte) && stored; };
  // A robot that took damaged bytes for the start of a long command waits for the remainder and swallows our request.
  for (std::size_t i = 0; whole && tries_ > kTriesToPadding && i < kPadding; ++i) put(kStart);
  if (whole) put(kStart);
  if (whole && config_.mode != Mode::kPassive) put(config_.mode == Mode::kSafe ? kSafe : kFull);
  put(kStream);
  put(2);
  put(config_.model == Model::kCreate1 ? 19 : 43);
  put(config_.model == Model::kCreate1 ? 20 : 44);
  FENCEPOST_CHECK(stored);
  (void)outbox_.put(bytes.view());  // no room: the line is blocked; the next step retries
}

// A robot whose wheels are not heard of is not driven on.
void Session::steer(base::Time now) {
  if (!motion_) return;
  const Motion wanted = allowed_ && streaming_ ? *motion_ : Motion{};
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
