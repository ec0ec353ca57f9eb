// The judgement of one run on a promise, and how a family of encounters adds up.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/studies/hazards/encounter_run.hpp"
#include "tests/studies/hazards/in_force.hpp"
#include "tests/studies/hazards/truth.hpp"

namespace fencepost::test {

struct Outcome {
  double seconds = 0;
  unsigned asked = 0;            ///< times that the promise was to be kept
  unsigned kept = 0;             ///< of those
  std::vector<double> measures;  ///< of each, in the cell's unit
  unsigned false_stops = 0;      ///< beginnings of a stop without a reason
  unsigned grazes = 0;           ///< of those, something passes the margin by less than kGrace
  std::vector<std::string> failures;

  void add(const Outcome& other);
};

/// One run with all that judges need.
struct Judged {
  Judged(const Encounter& met, Listener& listener) : Judged(met, run_encounter(met, listener)) {}
  /// Of a run that was made; `met` has to outlive it.
  Judged(const Encounter& met, History made);
  Judged(const Judged&) = delete;
  Judged& operator=(const Judged&) = delete;

  const Encounter& encounter;
  History history;
  RunTruth truth;
  Stretches stops;
  Stretches warnings;  ///< warn or stop
  Stretches alerts;    ///< notice or more
};

/// Counts the stops that nothing calls for.
void judge_false_stops(const Judged& run, Outcome& outcome);
/// A stop has to be in force all the time from `due` to `until`. Returns when the one began that was in force when due,
/// or else the first later one before `until`.
std::optional<double> judge_stop(const Judged& run, double due, double until, Outcome& outcome);

/// Frames that had shown the object by then.
unsigned frames_before(const History& history, std::size_t object, double t);

/// The object comes within alert.stop in the robot's path. A stop has to be in force from then until the contact or the
/// end of the run. If the margin alone would touch, it only has to be at that moment. Measures the distance at which
/// the stop began, m; 0: never. Not asked if fewer than k frames had shown it, or if it was as near from the beginning.
void judge_approached(const Judged& run, std::size_t object, Outcome& outcome);
/// The body touches the object at last: a stop is due `before` s before. Measures how long before it began, s; 0:
/// never.
inline constexpr double kBefore = 0.5;
void judge_contact(const Judged& run, std::size_t object, Outcome& outcome, double before = kBefore);
/// No stop at all, and no complaint about a camera that is as configured.
void judge_no_stop(const Judged& run, Outcome& outcome);
/// Of an obedient robot: no contact. Once it has heard stop, a warn or a stop is in force while it is within `within` m
/// of the object. Measures how often it was without.
void judge_silence(const Judged& run, std::size_t object, double within, Outcome& outcome);
/// From `limit` after `from` until `until` a stop, or that it is blind, is in force. `limit` later nothing is any more,
/// if the run goes on that long. Measures how long the report took, s.
void judge_told(const Judged& run, double from, double until, double limit, Outcome& outcome);
/// The object of that signature is gone from `gone` on. An alert was in force then, and none is `limit` later. Alerts
/// about another colour, or farther than `background` (m), do not count. Measures how long they stayed, s.
void judge_removal(const Judged& run, std::uint8_t signature, double gone, double limit, double background,
                   Outcome& outcome);

}  // namespace fencepost::test
