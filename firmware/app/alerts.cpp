#include "firmware/app/alerts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
static float env(const char* n, float d) { const char* v = std::getenv(n); return v ? strtof(v, nullptr) : d; }
static const float kPoseSigma = env("PS", 0.004F), kCautionSigmas = env("CS", 2.5F), kMostCaution = env("MC", 0.25F), kLookSeconds = env("LS", 0.1F);

namespace fencepost::app {

using config::Key;
using record::AlertLevel;

namespace {

// What the obstacle may be nearer than it seems, now or before the next look (m).
float caution(const Obstacle& obstacle, float stop) {
  const float unsure = std::sqrt(obstacle.sigma * obstacle.sigma + kPoseSigma * kPoseSigma);
  const float doubt = std::min(kCautionSigmas * unsure, kMostCaution * stop);
  const float until_next_look = obstacle.closing ? obstacle.closing_speed * kLookSeconds : 0.0F;
  return doubt + until_next_look;
}

}  // namespace

bool credible(const recon::ObjectCore& object) { return object.confirmed && object.missed_in_a_row < kGoneAfterMisses; }

AlertLevel level_for(const Obstacle& obstacle, const config::Settings& settings, float slack) {
  if (!obstacle.known) return AlertLevel::kClear;
  const auto near = [&](Key key) { return obstacle.distance <= slack * settings.number(key); };
  const auto soon = [&](Key key) { return obstacle.closing && obstacle.ttc <= slack * settings.number(key); };
  if (!obstacle.in_path) return near(Key::kAlertWarn) ? AlertLevel::kNotice : AlertLevel::kClear;
  const float stop = settings.number(Key::kAlertStop);
  if (obstacle.distance - caution(obstacle, stop) <= slack * stop || soon(Key::kAlertTtcStop)) return AlertLevel::kStop;
  if (near(Key::kAlertWarn) || soon(Key::kAlertTtcWarn)) return AlertLevel::kWarn;
  if (near(Key::kAlertNotice)) return AlertLevel::kNotice;
  return AlertLevel::kClear;
}

std::optional<AlertLevel> judge(AlertState& state, const recon::ObjectCore& object, const Obstacle& obstacle,
                                const config::Settings& settings, base::Time now) {
  if (state.id != object.id) {
    state = AlertState{};
    state.id = object.id;
  }
  const bool believed = credible(object);
  const AlertLevel due = believed ? level_for(obstacle, settings, 1.0F) : AlertLevel::kClear;
  if (due > state.level) {
    state.level = due;
    state.easing = false;
    state.said_at = Stamp(now);
    return due;
  }
  const AlertLevel held = believed ? level_for(obstacle, settings, kHysteresis) : AlertLevel::kClear;
  if (held < state.level) {
    if (!state.easing) {
      state.easing = true;
      state.easing_since = Stamp(now);
    }
    if (state.easing_since.since(now) >= kEaseAfter) {
      state.level = held;
      state.easing = false;
      state.said_at = Stamp(now);
      return held;
    }
  } else {
    state.easing = false;
  }
  base::Duration interval{base::Time::kPerUnit / settings.raw(Key::kAlertRate)};
  if (state.level == AlertLevel::kNotice && interval < kNoticeInterval) interval = kNoticeInterval;
  if (state.level > AlertLevel::kClear && state.said_at.since(now) >= interval) {
    state.said_at = Stamp(now);
    return state.level;
  }
  return std::nullopt;
}

}  // namespace fencepost::app
