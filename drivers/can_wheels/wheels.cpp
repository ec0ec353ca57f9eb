#include "drivers/can_wheels/wheels.hpp"

namespace fencepost::can_wheels {
namespace {

constexpr std::int64_t kPicometresPerMicrometre = 1'000'000;
// Minimum silence of a restart: no controller restarts faster.
constexpr base::Duration kRestartTakes = base::milliseconds(200);
// Maximum silence over which a velocity is integrated.
constexpr base::Duration kLongestStep = base::milliseconds(500);

// Unit of the counts given to the pairs: the device's, or micrometres.
odometry::WheelBase counted(const Mapping& mapping) {
  odometry::WheelBase wheels = mapping.wheels;
  if (mapping.quantity == Quantity::kVelocities) {
    wheels.left_pm_per_count = wheels.right_pm_per_count = kPicometresPerMicrometre;
    wheels.counter_bits = 32;
  }
  return wheels;
}

std::int64_t magnitude(std::int64_t value) { return value < 0 ? -value : value; }

}  // namespace

Wheels::Wheels(const Mapping& mapping) : mapping_(mapping), pairs_(counted(mapping)) {
  FENCEPOST_CHECK(mapping.wheels.left_pm_per_count != 0 && mapping.wheels.right_pm_per_count != 0);
}

std::optional<sensor::OdometrySample> Wheels::take(const bus::CanFrame& frame, base::Time t) {
  const bool is_left = carries(frame, mapping_.left);
  const bool is_right = carries(frame, mapping_.right);
  if (!is_left && !is_right) {
    ++counters_.unrelated;
    return std::nullopt;
  }
  ++counters_.frames;
  std::optional<std::uint32_t> left;
  std::optional<std::uint32_t> right;
  if (is_left) left = count_in(frame, mapping_.left, mapping_.wheels.left_pm_per_count, left_, t);
  if (is_right) right = count_in(frame, mapping_.right, mapping_.wheels.right_pm_per_count, right_, t);
  if (left.has_value() != is_left || right.has_value() != is_right) {
    ++counters_.malformed;
    return std::nullopt;
  }
  if (is_left && is_right) return pairs_.take_both(*left, *right, t);
  if (is_left) return pairs_.take_left(*left, t);
  pairs_.take_right(*right, t);
  return std::nullopt;
}

std::optional<std::uint32_t> Wheels::count_in(const bus::CanFrame& frame, const Signal& signal, std::int64_t scale_pm,
                                              Wheel& wheel, base::Time t) {
  const std::optional<std::int64_t> value = value_in(frame, signal);
  if (!value) return std::nullopt;
  if (mapping_.quantity == Quantity::kVelocities) return integrate(*value, scale_pm, wheel, t);
  const auto count = static_cast<std::uint32_t>(*value);
  if (has_restarted(wheel, count, t)) pairs_.forget();
  wheel.heard = t;
  wheel.count = count;
  return count;
}

bool Wheels::has_restarted(const Wheel& wheel, std::uint32_t count, base::Time t) const {
  if (!wheel.heard || t - *wheel.heard < kRestartTakes) return false;
  const int unused = 32 - mapping_.wheels.counter_bits;
  const auto size = [unused](std::uint32_t difference) {
    return magnitude(static_cast<std::int32_t>(difference << unused) >> unused);
  };
  return size(count) < size(count - wheel.count);
}

std::optional<std::uint32_t> Wheels::integrate(std::int64_t value, std::int64_t scale_pm, Wheel& wheel,
                                               base::Time t) const {
  const std::int64_t fastest_pm_s = mapping_.wheels.max_speed_mm_s * odometry::kPicometresPerMillimetre;
  if (magnitude(value) > fastest_pm_s / magnitude(scale_pm)) return std::nullopt;
  const std::int64_t speed_pm_s = value * scale_pm;
  const base::Duration step = wheel.heard ? t - *wheel.heard : base::Duration{};
  if (step.raw > 0 && step <= kLongestStep) {
    wheel.way_pm += (wheel.speed_pm_s + speed_pm_s) / 2 * step.raw / base::Duration::kPerUnit;
  }
  wheel.speed_pm_s = speed_pm_s;
  wheel.heard = t;
  return static_cast<std::uint32_t>(odometry::divide_nearest(wheel.way_pm, kPicometresPerMicrometre));
}

bool Wheels::heard_lately(const Wheel& wheel, base::Time now) const {
  return wheel.heard && now - *wheel.heard <= mapping_.silence;
}

sensor::LinkState Wheels::link(base::Time now) const {
  const int heard = (heard_lately(left_, now) ? 1 : 0) + (heard_lately(right_, now) ? 1 : 0);
  if (heard == 2) return sensor::LinkState::kOk;
  return heard == 1 ? sensor::LinkState::kUnready : sensor::LinkState::kSilent;
}

void Wheels::forget() {
  pairs_.forget();
  left_.heard.reset();
  right_.heard.reset();
}

}  // namespace fencepost::can_wheels
