// One approach through the robot's own loop, and the judgement of its alerts.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "firmware/record/records.hpp"
#include "host/result/result.hpp"
#include "tests/studies/alerts/ground_truth.hpp"

namespace fencepost::test {

struct AlertRequest {
  std::string profile = "full";
  std::vector<record::Setting> settings;  ///< given to the robot, not to the judge: to plant a fault
};

/// Of a block in the path that came within the stop distance after the robot had seen it in k frames.
struct ObstacleVerdict {
  std::size_t object = 0;
  double due = 0;                   ///< s, when its true distance fell to alert.stop
  bool body = false;                ///< the body itself would touch it, not only its margin
  unsigned visible = 0;             ///< frames before that which showed it
  unsigned placed = 0;              ///< of those, the ones that showed its foot and one of its ends
  bool in_time = false;             ///< `stop` was in force for it when due
  std::optional<double> late_by{};  ///< s; empty: not said in this run
};

/// m outside the margin: poses and edges are not good enough to distinguish a thing here from one in the margin.
inline constexpr double kGrace = 0.03;

/// A `stop` with nothing in the path near enough.
struct FalseStop {
  record::AlertReport alert;
  bool grazes = false;                   ///< something passes the margin by less than kGrace
  std::optional<std::size_t> follows{};  ///< whose blobs that object took
};

struct Delay {
  std::size_t object = 0;
  double due = 0;       ///< s, the frame that completed k-of-n
  unsigned frames = 0;  ///< from there to the first alert
};

struct Verdict {
  double seconds = 0;
  std::vector<ObstacleVerdict> obstacles;
  std::vector<FalseStop> false_stops;
  /// Of blocks that were well within alert.warn by then: frames from the one that completed k-of-n to the first alert.
  /// An alert that never came counts the frames to the end.
  std::vector<Delay> delays;
  unsigned phantoms = 0;   ///< confirmed objects that mean no block: a second one for it, or of false blobs
  unsigned misplaced = 0;  ///< confirmed objects that took the blobs of a block, yet are not where it is
  unsigned seen = 0;       ///< blocks that at least host::kVisibleFrames frames showed by themselves
  unsigned missed = 0;     ///< of those, without a confirmed object
  unsigned stale = 0;      ///< ids with an alert in force at the end that are no object's any more
  std::vector<record::AlertReport> alerts;
  std::vector<host::ObjectResult> objects;             ///< the map at the end
  std::vector<std::optional<std::size_t>> followed{};  ///< by those objects: whose blobs they took most often
};

/// errors: throws std::runtime_error with a sentence
Verdict judge_approach(const Approach& approach, const AlertLimits& limits, const AlertRequest& request);

}  // namespace fencepost::test
