// From obstacles to alerts: levels with hysteresis, one state per object, repeated at a bounded rate.
#pragma once

#include <cstdint>
#include <optional>

#include "firmware/alert/obstacle.hpp"
#include "firmware/alert/tuning.hpp"
#include "firmware/config/settings.hpp"
#include "firmware/record/records.hpp"
#include "hal/base/stamp.hpp"
#include "hal/base/units.hpp"

namespace fencepost::alert {

/// The alert in force for one object, and what was last reported of it. It is reset when the object ends, so that
/// nothing of it is left for the next one in its slot.
struct AlertState {
  record::AlertLevel level = record::AlertLevel::kClear;
  bool easing = false;  ///< a lower level is due, waiting for kEaseAfter
  std::uint8_t signature = 0;
  record::AlertLevel said = record::AlertLevel::kClear;  ///< in words, see is_new()
  base::Metres said_distance;
  base::Stamp easing_since;
  base::Stamp reported_at;
  base::Metres distance;
  base::Radians bearing;

  [[nodiscard]] bool in_force() const { return level > record::AlertLevel::kClear; }
};

/// True if a report has to be shown to a person again, and updates the state: its level has changed, or its distance by
/// kSaidAgain. Records and outputs repeat an alert as long as it is in force; in words that would bury all others.
bool is_new(AlertState& state, const record::AlertReport& report);

/// The settings as numbers to compare with, once for all objects.
struct AlertRules {
  /// Distances are widened by `caution` >= 1.
  explicit AlertRules(const config::Settings& settings, float caution = 1);
  float stop;      ///< m
  float warn;      ///< m
  float notice;    ///< m
  float ttc_stop;  ///< s
  float ttc_warn;  ///< s
  base::Duration repeat;
};

/// Worth an alert: confirmed, and not gone from where it should be.
[[nodiscard]] bool credible(const recon::ObjectCore& object);

/// The level that the distances, widened by `slack` >= 1, call for. Only an obstacle in the path warns or stops; any
/// other as near as alert.warn gives a notice. A stop is early rather than late. An uncertain distance counts as
/// shorter, and so does one that shrinks before the path is watched again. All distances are moved by the obstacle's
/// overhang.
record::AlertLevel level_for(const Obstacle& obstacle, const AlertRules& rules, float slack);

/// m/s. The largest speed from which the robot still stops: one that slows down as this falls is not stopped by the
/// time to contact. `free`: m until the body touches; `ttc_stop`: s before it, where STOP is due; `before_stop`: m
/// until alert.stop.
[[nodiscard]] float stopping_speed(float free, float ttc_stop, float before_stop);
/// m/s, the same before an obstacle; kFastest: none before this one.
[[nodiscard]] float stopping_speed(const Obstacle& obstacle, const RobotPath& path, const AlertRules& rules);

/// Updates a state and returns the level to report now, if any. A rise to `due` is reported at once. Warn and stop
/// repeat at most alert.rate times a second, notice once a second. An easing to `held`, which is `due` with the
/// hysteresis, is reported once it has lasted for kEaseAfter.
std::optional<record::AlertLevel> follow(AlertState& state, record::AlertLevel due, record::AlertLevel held,
                                         const AlertRules& rules, base::Time now);

/// The same for an object.
std::optional<record::AlertLevel> judge(AlertState& state, const recon::ObjectCore& object, const Obstacle& obstacle,
                                        const AlertRules& rules, base::Time now);

}  // namespace fencepost::alert
