#include "tests/studies/hazards/outcome.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "tests/studies/alerts/judgement.hpp"

namespace fencepost::test {

using record::AlertLevel;

void Outcome::add(const Outcome& other) {
  seconds += other.seconds;
  asked += other.asked;
  kept += other.kept;
  measures.insert(measures.end(), other.measures.begin(), other.measures.end());
  false_stops += other.false_stops;
  grazes += other.grazes;
}

Judged::Judged(const Encounter& met, History made)
    : encounter(met),
      history(std::move(made)),
      truth(encounter, history),
      stops(history.alerts, AlertLevel::kStop),
      warnings(history.alerts, AlertLevel::kWarn),
      alerts(history.alerts, AlertLevel::kNotice) {}

void judge_false_stops(const Judged& run, Outcome& outcome) {
  outcome.seconds += run.history.end;
  for (const Stretch& stop : run.stops.all()) {
    if (run.truth.stop_is_right(stop.from, 0)) continue;
    const bool grazes = run.truth.stop_is_right(stop.from, kGrace);
    ++outcome.false_stops;
    outcome.grazes += grazes ? 1U : 0U;
    outcome.failures.push_back(fmt::format("{} from {:.2f} to {:.2f} s, nearest at {:.3f} m",
                                           grazes ? "graze" : "false", stop.from, stop.to,
                                           run.truth.distance(stop.from)));
  }
}

std::optional<double> judge_stop(const Judged& run, double due, double until, Outcome& outcome) {
  ++outcome.asked;
  const bool kept = run.stops.throughout(due, until);
  outcome.kept += kept ? 1U : 0U;
  std::optional<double> began;
  for (const Stretch& stop : run.stops.all()) {
    if (!began && stop.to > due && stop.from <= until) began = stop.from;
  }
  if (!kept) {
    std::string text = fmt::format("stop due from {:.2f} to {:.2f} s, in force", due, until);
    for (const Stretch& stop : run.stops.all()) text += fmt::format(" {:.2f}..{:.2f}", stop.from, stop.to);
    outcome.failures.push_back(text + (run.stops.all().empty() ? " never" : ""));
  }
  return began;
}

unsigned frames_before(const History& history, std::size_t object, double t) {
  const std::vector<double>& shown = history.shown[object];
  return static_cast<unsigned>(std::upper_bound(shown.begin(), shown.end(), t) - shown.begin());
}

void judge_approached(const Judged& run, std::size_t object, Outcome& outcome) {
  const AlertLimits limits;
  const std::optional<double> due = run.truth.first_within(object, limits.stop);
  if (!due || *due == 0 || !run.truth.meets_in(object, *due, limits.margin)) return;
  if (frames_before(run.history, object, *due) < static_cast<unsigned>(limits.confirm_k)) return;
  // A stop is due to the end if the body would touch the object. That also holds where the run ends before the contact,
  // or at another thing in front of it.
  const bool touches = run.truth.meets_in(object, *due, kTouching).has_value();
  const double until = run.truth.contact(object).value_or(touches ? run.history.end : *due);
  const std::optional<double> began = judge_stop(run, *due, until, outcome);
  outcome.measures.push_back(began ? run.truth.distance(object, *began) : 0);
}

void judge_contact(const Judged& run, std::size_t object, Outcome& outcome, double before) {
  const std::optional<double> contact = run.truth.contact(object);
  if (!contact) return;
  if (frames_before(run.history, object, *contact - before) < static_cast<unsigned>(AlertLimits{}.confirm_k)) return;
  const std::optional<double> began = judge_stop(run, *contact - before, *contact, outcome);
  outcome.measures.push_back(began ? *contact - *began : 0);
}

void judge_no_stop(const Judged& run, Outcome& outcome) {
  ++outcome.asked;
  const std::vector<std::string>& complaints = run.history.complaints;
  outcome.kept += run.stops.all().empty() && complaints.empty() ? 1U : 0U;
  outcome.failures.insert(outcome.failures.end(), complaints.begin(), complaints.end());
}

void judge_silence(const Judged& run, std::size_t object, double within, Outcome& outcome) {
  ++outcome.asked;
  const std::optional<double> contact = run.truth.contact(object);
  const double first = run.stops.all().empty() ? run.history.end : run.stops.all().front().from;
  unsigned clears = 0;
  bool silent = false;
  std::string places;
  for (double t = first; t <= run.history.end; t += kTruthStep) {
    const bool before = std::exchange(silent, run.truth.distance(object, t) <= within && !run.warnings.at(t));
    if (!silent || before) continue;
    ++clears;
    places += fmt::format(" {:.2f} s ({:.3f} m)", t, run.truth.distance(object, t));
  }
  outcome.measures.push_back(clears);
  if (contact || clears > 0) {
    outcome.failures.push_back(fmt::format("first stop {:.2f} s, {} times clear{}{}", first, clears, places,
                                           contact ? fmt::format(", contact at {:.2f} s", *contact) : ""));
  } else {
    ++outcome.kept;
  }
}

void judge_told(const Judged& run, double from, double until, double limit, Outcome& outcome) {
  ++outcome.asked;
  const double end = std::min(until, run.history.end);
  double told = end;
  for (const Stretch& stop : run.stops.all()) {
    if (stop.to > from) told = std::min(told, std::max(stop.from, from));
  }
  outcome.measures.push_back(told - from);
  const bool over = until + limit >= run.history.end || !run.stops.at(until + limit);
  if (run.stops.throughout(from + limit, end) && over) {
    ++outcome.kept;
  } else {
    outcome.failures.push_back(fmt::format("blind from {:.2f} to {:.2f} s, reported after {:.2f} s{}", from, end,
                                           told - from, over ? "" : ", and still afterwards"));
  }
}

void judge_removal(const Judged& run, std::uint8_t signature, double gone, double limit, double background,
                   Outcome& outcome) {
  ++outcome.asked;
  std::vector<record::AlertReport> alerts = run.history.alerts;
  for (record::AlertReport& alert : alerts) {
    const bool of_another = alert.signature != signature && alert.signature != 0;
    if (of_another || alert.distance.to_double() > background) alert.level = AlertLevel::kClear;
  }
  const Stretches of_it(alerts, AlertLevel::kNotice);
  const bool before = of_it.at(gone);
  double last = gone;
  for (const Stretch& alert : of_it.all()) {
    if (alert.to > gone) last = std::max(last, std::min(alert.to, run.history.end));
  }
  outcome.measures.push_back(last - gone);
  if (before && last - gone <= limit) {
    ++outcome.kept;
  } else {
    outcome.failures.push_back(
        fmt::format("{}in force when it was taken away, {:.2f} s afterwards", before ? "" : "not ", last - gone));
  }
}

}  // namespace fencepost::test
