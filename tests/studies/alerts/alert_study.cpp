// Prints how good the alerts are on random approaches, a row a noise level. Fails when the level of --judge misses its
// targets.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "tests/studies/alerts/judgement.hpp"
#include "tests/studies/common/study.hpp"

namespace fencepost::test {
namespace {

struct Request {
  Seeds approaches{1000, 1};
  std::vector<std::string> levels;
  std::string judged = "2";
  std::vector<std::string> settings;
  double at_least = 99.5;
  double at_most = 1;
  double nearest = AlertLimits{}.warn;
  bool show = false;
  AlertRequest alerts;
};

struct Figures {
  unsigned approaches = 0;
  double minutes = 0;
  unsigned obstacles = 0;
  unsigned in_time = 0;
  unsigned late = 0;
  unsigned never = 0;
  unsigned bodies = 0;
  unsigned bodies_in_time = 0;
  unsigned placed = 0;
  unsigned placed_in_time = 0;
  unsigned false_stops = 0;
  unsigned grazes = 0;  ///< of those
  unsigned delays = 0;
  unsigned delayed = 0;
  unsigned phantoms = 0;
  unsigned misplaced = 0;
  unsigned seen = 0;
  unsigned missed = 0;
  unsigned stale = 0;

  [[nodiscard]] double in_ten_minutes(unsigned count) const { return minutes > 0 ? 10 * count / minutes : 0; }
};

double percent(unsigned part, unsigned whole) { return whole > 0 ? 100.0 * part / whole : 100; }

void add(const Verdict& verdict, Figures& figures) {
  ++figures.approaches;
  figures.minutes += verdict.seconds / 60;
  for (const ObstacleVerdict& obstacle : verdict.obstacles) {
    ++figures.obstacles;
    figures.in_time += obstacle.in_time ? 1U : 0U;
    figures.late += obstacle.late_by ? 1U : 0U;
    figures.never += !obstacle.in_time && !obstacle.late_by ? 1U : 0U;
    const bool placed = obstacle.placed >= static_cast<unsigned>(AlertLimits{}.confirm_k);
    figures.placed += placed ? 1U : 0U;
    figures.placed_in_time += placed && obstacle.in_time ? 1U : 0U;
    figures.bodies += obstacle.body ? 1U : 0U;
    figures.bodies_in_time += obstacle.body && obstacle.in_time ? 1U : 0U;
  }
  figures.false_stops += static_cast<unsigned>(verdict.false_stops.size());
  figures.grazes += static_cast<unsigned>(std::count_if(verdict.false_stops.begin(), verdict.false_stops.end(),
                                                        [](const FalseStop& stop) { return stop.grazes; }));
  figures.delays += static_cast<unsigned>(verdict.delays.size());
  figures.delayed += static_cast<unsigned>(
      std::count_if(verdict.delays.begin(), verdict.delays.end(), [](const Delay& delay) { return delay.frames > 0; }));
  figures.phantoms += verdict.phantoms;
  figures.misplaced += verdict.misplaced;
  figures.seen += verdict.seen;
  figures.missed += verdict.missed;
  figures.stale += verdict.stale;
}

void show(unsigned seed, const Approach& approach, const GroundTruth& truth, const Verdict& verdict) {
  const Drive& drive = approach.drive;
  const auto head = [&] {
    fmt::print("seed {} v {:.2f} k {:+.2f} stand {:.2f} end {:.2f}", seed, drive.speed, drive.curvature, drive.standing,
               approach.end);
  };
  for (const ObstacleVerdict& obstacle : verdict.obstacles) {
    if (obstacle.in_time) continue;
    head();
    fmt::print(": LATE {} {} due {:.2f} visible {} placed {} by {}\n", obstacle.object,
               obstacle.body ? "body" : "margin", obstacle.due, obstacle.visible, obstacle.placed,
               obstacle.late_by ? fmt::format("{:.2f}", *obstacle.late_by) : "never");
    for (const record::AlertReport& alert : verdict.alerts) {
      const double t = alert.t.to_double();
      if (t < obstacle.due - 1.5 || t > obstacle.due + 1) continue;
      fmt::print("    {:.2f} {} id {} at {:.3f} bearing {:.2f} conf {:.2f}; true {:.3f}\n", t,
                 record::name(alert.level), alert.id, alert.distance.to_double(), alert.bearing.to_double(),
                 alert.confidence.to_double(), truth.distance(obstacle.object, t));
    }
  }
  const auto map = [&] {
    for (std::size_t i = 0; i < verdict.objects.size(); ++i) {
      const host::ObjectResult& object = verdict.objects[i];
      fmt::print("    object {} {} of signature {} follows {} views {} {}\n", object.id, record::name(object.state),
                 object.signature, verdict.followed[i] ? std::to_string(*verdict.followed[i]) : "-", object.views,
                 object.models.front().reason);
    }
  };
  if (!verdict.false_stops.empty() || std::any_of(verdict.obstacles.begin(), verdict.obstacles.end(),
                                                  [](const auto& obstacle) { return !obstacle.in_time; })) {
    map();
  }
  for (const FalseStop& stop : verdict.false_stops) {
    head();
    const double t = stop.alert.t.to_double();
    fmt::print(": {} id {} t {:.2f} at {:.3f} bearing {:.2f} conf {:.2f} ttc {:.2f} follows {}\n",
               stop.grazes ? "GRAZE" : "FALSE", stop.alert.id, t, stop.alert.distance.to_double(),
               stop.alert.bearing.to_double(), stop.alert.confidence.to_double(),
               stop.alert.ttc ? stop.alert.ttc->to_double() : -1.0, stop.follows ? std::to_string(*stop.follows) : "-");
    for (std::size_t o = 0; o < approach.scene.objects.size(); ++o) {
      double least = 10;
      for (double s = t; s < approach.end + 1 / drive.speed; s += 0.01) least = std::min(least, truth.distance(o, s));
      fmt::print("    object {} true {:.3f} will be {:.3f}\n", o, truth.distance(o, t), least);
    }
  }
  for (const Delay& delay : verdict.delays) {
    if (delay.frames == 0) continue;
    head();
    fmt::print(": DELAY {} of block {} due {:.2f} true {:.3f} {}\n", delay.frames, delay.object, delay.due,
               truth.distance(delay.object, delay.due), truth.in_path(delay.object, delay.due) ? "in path" : "beside");
  }
}

void print_row(const NoiseLevel& level, const Figures& f) {
  fmt::print(
      "| {} | {} | {:.0f} | {} | {:.2f} | {} | {} | {:.2f} of {} | {:.2f} of {} | {} | {:.2f} | {:.2f} | {} of {} | "
      "{:.2f} | {} | {} of {} | {} |\n",
      level.key, f.approaches, f.minutes, f.obstacles, percent(f.in_time, f.obstacles), f.late, f.never,
      percent(f.bodies_in_time, f.bodies), f.bodies, percent(f.placed_in_time, f.placed), f.placed, f.false_stops,
      f.in_ten_minutes(f.false_stops), f.in_ten_minutes(f.false_stops - f.grazes), f.delayed, f.delays,
      f.in_ten_minutes(f.phantoms), f.misplaced, f.missed, f.seen, f.stale);
  std::fflush(stdout);
}

bool good(const Figures& f, const Request& request) {
  return f.obstacles > 0 && f.stale == 0 && percent(f.in_time, f.obstacles) >= request.at_least &&
         f.in_ten_minutes(f.false_stops - f.grazes) <= request.at_most;
}

// Borrows the texts of the request.
AlertRequest alerts_of(const Request& request) {
  AlertRequest alerts = request.alerts;
  for (const std::string_view setting : request.settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string_view::npos) throw std::runtime_error("--set takes KEY=VALUE");
    alerts.settings.push_back({setting.substr(0, equals), setting.substr(equals + 1)});
  }
  return alerts;
}

Figures run_level(const NoiseLevel& level, const Request& request, const AlertRequest& alerts) {
  Figures figures;
  for (unsigned i = 0; i < request.approaches.scenes; ++i) {
    const unsigned seed = request.approaches.first + i;
    const Approach approach = random_approach(seed, level, request.nearest);
    if (approach.scene.objects.empty()) continue;
    const AlertLimits limits;
    const Verdict verdict = judge_approach(approach, limits, alerts);
    add(verdict, figures);
    if (request.show) show(seed, approach, GroundTruth(approach, limits), verdict);
  }
  return figures;
}

bool run(const Request& request) {
  const AlertRequest alerts = alerts_of(request);
  fmt::print(
      "| noise | approaches | minutes | obstacles | in time, % | late | never | of those the body meets, % | of those "
      "placed, % | "
      "false stops | in 10 min | without grazes | alert after k-of-n | phantoms in 10 min | misplaced | missed | stale "
      "|\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  bool all_good = false;  // the level that is judged has to be among those that are run
  for (const NoiseLevel& level : noise_levels(request.levels)) {
    const Figures figures = run_level(level, request, alerts);
    print_row(level, figures);
    if (level.key == request.judged) all_good = good(figures, request);
  }
  return all_good;
}

void options(CLI::App& app, Request& request) {
  add_seed_options(app, request.approaches, "a level", "--approaches");
  add_levels_option(app, request.levels);
  app.add_option("--judge", request.judged, "the level that has to meet the targets")->capture_default_str();
  app.add_option("--at-least", request.at_least, "% of the obstacles in time")->capture_default_str();
  app.add_option("--at-most", request.at_most, "false stops in 10 minutes, grazes left out")->capture_default_str();
  add_profile_option(app, request.alerts.profile);
  app.add_option("--set", request.settings, "KEY=VALUE for the robot, not for its judge: plants a fault");
  app.add_option("--nearest", request.nearest, "m, no block is nearer when the robot starts")->capture_default_str();
  app.add_flag("--show", request.show, "tell of each failure");
}

constexpr Study<Request> kStudy = {"alert_study", "How good the alerts are on random approaches, a row a noise level",
                                   options, run};

}  // namespace
}  // namespace fencepost::test

int main(int argc, char** argv) { return fencepost::test::kStudy.main(argc, argv); }
