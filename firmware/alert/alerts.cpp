#include "firmware/alert/alerts.hpp"

#include <algorithm>
#include <cmath>

namespace fencepost::alert {

using config::Key;
using record::AlertLevel;

namespace {

float margin_of(const Obstacle& obstacle, const InPath& way, float stop) {
  const Margin& margin = obstacle.cut_off ? kCutOff : kSeenWhole;
  const float sigma = std::sqrt(way.sigma * way.sigma + recon::kPositionNoise * recon::kPositionNoise);
  return std::min(margin.sigmas * sigma, margin.most * stop);
}

// Within the stop distance now, with the margin, or before the path is judged again.
bool must_stop(const Obstacle& obstacle, const InPath& way, float stop, float slack) {
  const float until_next_look = obstacle.closing ? obstacle.closing_speed * kLookSeconds : 0.0F;
  const float distance = obstacle.distance - obstacle.overhang;
  return distance - margin_of(obstacle, way, stop) - until_next_look <= slack * stop;
}

// And reports it.
AlertLevel change(AlertState& state, AlertLevel level, base::Time now) {
  state.level = level;
  state.easing = false;
  state.reported_at = base::Stamp(now);
  return level;
}

}  // namespace

bool is_new(AlertState& state, const record::AlertReport& report) {
  const std::int32_t step = report.distance.raw - state.said_distance.raw;
  const bool moved = step >= kSaidAgain.raw || step <= -kSaidAgain.raw;
  if (report.level == state.said && !moved) return false;
  state.said = report.level;
  state.said_distance = report.distance;
  return true;
}

AlertRules::AlertRules(const config::Settings& settings, float caution)
    : stop(caution * settings.number(Key::kAlertStop)),
      warn(caution * settings.number(Key::kAlertWarn)),
      notice(caution * settings.number(Key::kAlertNotice)),
      ttc_stop(settings.number(Key::kAlertTtcStop)),
      ttc_warn(settings.number(Key::kAlertTtcWarn)),
      repeat{static_cast<std::int32_t>(base::Time::kPerUnit) / settings.raw(Key::kAlertRate)} {}

bool credible(const recon::ObjectCore& object) { return object.confirmed && !object.refuted(); }

AlertLevel level_for(const Obstacle& obstacle, const AlertRules& rules, float slack) {
  if (!obstacle.known) return AlertLevel::kClear;
  const auto near = [&](float distance) { return obstacle.distance - obstacle.overhang <= slack * distance; };
  const auto soon = [&](float seconds) { return obstacle.closing && obstacle.ttc <= slack * seconds; };
  const bool may_be_there = !obstacle.guessed || obstacle.toward.x() > 0;
  if (!obstacle.in_path) return may_be_there && near(rules.warn) ? AlertLevel::kNotice : AlertLevel::kClear;
  if (obstacle.unbacked) return may_be_there && near(rules.notice) ? AlertLevel::kNotice : AlertLevel::kClear;
  if (must_stop(obstacle, *obstacle.in_path, rules.stop, slack) || soon(rules.ttc_stop)) return AlertLevel::kStop;
  if (near(rules.warn) || soon(rules.ttc_warn)) return AlertLevel::kWarn;
  if (near(rules.notice)) return AlertLevel::kNotice;
  return AlertLevel::kClear;
}

float stopping_speed(float free, float ttc_stop, float before_stop) {
  return std::max(0.0F, std::min(free / (ttc_stop + kSlowsWithin), before_stop / kLookSeconds));
}

float stopping_speed(const Obstacle& obstacle, const RobotPath& path, const AlertRules& rules) {
  if (!obstacle.known || !obstacle.in_path || obstacle.unbacked) return kFastest;
  const float range = obstacle.toward.norm();
  const float share = range > 0 ? std::fabs(obstacle.toward.x()) / range : 0.0F;
  if (!(share > 0)) return kFastest;
  const float margin = margin_of(obstacle, *obstacle.in_path, rules.stop);
  const float before_stop = obstacle.distance - obstacle.overhang - margin - rules.stop;
  return stopping_speed(way_to(path, obstacle, share), rules.ttc_stop, before_stop / share);
}

std::optional<AlertLevel> follow(AlertState& state, AlertLevel due, AlertLevel held, const AlertRules& rules,
                                 base::Time now) {
  if (due > state.level) return change(state, due, now);
  if (held < state.level) {
    if (!state.easing) {
      state.easing = true;
      state.easing_since = base::Stamp(now);
    }
    if (state.easing_since.since(now) >= kEaseAfter) return change(state, held, now);
  } else {
    state.easing = false;
  }
  base::Duration interval = rules.repeat;
  if (state.level == AlertLevel::kNotice && interval < kNoticeInterval) interval = kNoticeInterval;
  if (state.in_force() && state.reported_at.since(now) >= interval) {
    state.reported_at = base::Stamp(now);
    return state.level;
  }
  return std::nullopt;
}

std::optional<AlertLevel> judge(AlertState& state, const recon::ObjectCore& object, const Obstacle& obstacle,
                                const AlertRules& rules, base::Time now) {
  // To be refuted it had to be missing for long enough: no further easing.
  if (object.refuted() && state.in_force()) return change(state, AlertLevel::kClear, now);
  const bool believed = credible(object);
  const AlertLevel due = believed ? level_for(obstacle, rules, 1.0F) : AlertLevel::kClear;
  // A thing that the guard has lost below the image is still there.
  Obstacle still = obstacle;
  still.unbacked = false;
  const bool may_hold = believed && state.in_force();
  const AlertLevel held = may_hold ? level_for(still, rules, kHysteresis) : AlertLevel::kClear;
  return follow(state, due, held, rules, now);
}

}  // namespace fencepost::alert
