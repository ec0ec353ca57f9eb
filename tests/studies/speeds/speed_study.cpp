// A robot that obeys the speed limit, beside one that obeys STOP alone. How often does each touch something, how fast
// is it at STOP, where does it stand, and how long does it take?
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/geometry/rings.hpp"
#include "tests/studies/common/study.hpp"
#include "tests/studies/hazards/scenery.hpp"

namespace fencepost::test {
namespace {

struct Request {
  Seeds scenes{200, 1};
  std::string level = "2";
  std::string profile = "full";
  std::vector<std::string> settings;
  std::string scene;
  bool judge = false;
  bool show = false;
};

/// A lens and its frames a second: varied in each cell.
struct Eyes {
  Lens lens;
  double rate;
};
const std::vector<Eyes> kEyes = {
    {{43, 0.15, 0}, 10}, {{43, 0.15, 0}, 25}, {{43, 0.15, 0}, 50}, {{60, 0.15, 0}, 25}, {{43, 0.25, 0.3}, 25}};
constexpr double kSpeeds[] = {0.2, 0.4, 0.6};  // m/s
/// Geared motors, and a heavy robot, whose way to brake does not fit into alert.stop: 0.18 m from 0.2 m/s.
struct Brakes {
  const char* name;
  Brake brake;
};
constexpr Brakes kBrakes[] = {{"quick", {0.1, 0.2}}, {"slow", {0.3, 1.2}}};

/// A scene: what stands or moves where, and how far the robot means to drive.
struct Scene {
  const char* name;
  bool ends;  ///< at something in the way; else the way is free
  Encounter (*make)(Dice& dice, const host::TimedPose& start, double speed);
};

constexpr double kFreeWay = 3;  // m

Encounter towards(const host::TimedPose& start, double seconds, double speed) {
  Encounter met;
  met.route = Route(start, {{0.5, 0, 0}, {1, speed, 0}});
  met.seconds = 0.5 + seconds;
  return met;
}

Encounter wall(Dice& dice, const host::TimedPose& start, double speed) {
  const double ahead = dice.between(1.2, 1.8);
  Encounter met = towards(start, ahead / speed + 8, speed);
  const host::TimedPose face = relative(start, ahead + 0.015, dice.between(-0.5, 0.5), dice.between(-0.7, 0.7));
  met.scene.objects = {thing("wall", random_colour(dice), dice.between(0.1, 0.3), box_at(face, 0.03, 3))};
  return met;
}

Encounter block(Dice& dice, const host::TimedPose& start, double speed) {
  const double ahead = dice.between(1.2, 1.8);
  Encounter met = towards(start, ahead / speed + 8, speed);
  met.scene.objects = {random_block(dice, start, ahead, dice.between(-0.08, 0.08))};
  return met;
}

// It crosses from the side and comes to rest in the way.
Encounter ball(Dice& dice, const host::TimedPose& start, double speed) {
  const double ahead = dice.between(1.4, 2.0);
  Encounter met = towards(start, ahead / speed + 8, speed);
  const double radius = dice.between(0.03, 0.06);
  const double side = dice.below(2) == 0 ? 1 : -1;
  const host::TimedPose from = relative(start, ahead, 0.8 * side);
  const host::TimedPose to = relative(start, ahead, dice.between(-0.05, 0.05));
  host::SceneObject object =
      thing("ball", random_colour(dice), 2 * radius, {host::circle_ring({from.x, from.y}, radius, 32), {}});
  const double begins = 0.5 + dice.between(0.2, 0.6) * ahead / speed;
  const double lasts = 0.8 / dice.between(0.3, 0.8);
  object.path = {{0, from.x, from.y, from.heading},
                 {begins, from.x, from.y, from.heading},
                 {begins + lasts, to.x, to.y, from.heading}};
  met.scene.objects = {object};
  return met;
}

// Blocks beside the way, 3 to 12 cm outside the margin.
Encounter beside(Dice& dice, const host::TimedPose& start, double speed) {
  constexpr double kMargin = 0.15;  // m, half the width and robot.margin
  Encounter met = towards(start, 4 * kFreeWay / speed, speed);
  for (int i = 0; i < 5; ++i) {
    const double side = dice.below(2) == 0 ? 1 : -1;
    const host::TimedPose at = relative(start, 0.8 + 0.5 * i, 0);
    host::SceneObject object = random_block(dice, at, 0, 0);
    double nearest = std::numeric_limits<double>::infinity();
    for (const host::Point& p : object.footprint.outer) {
      const double left = std::cos(at.heading) * (p.y - at.y) - std::sin(at.heading) * (p.x - at.x);
      nearest = std::min(nearest, side * left);
    }
    const host::TimedPose away = relative({}, 0, side * (kMargin + dice.between(0.03, 0.12) - nearest));
    const host::TimedPose moved = relative({0, 0, 0, at.heading}, away.x, away.y);
    object.footprint = host::moved(object.footprint, 0, {moved.x, moved.y});
    met.scene.objects.push_back(object);
  }
  return met;
}

constexpr Scene kScenes[] = {
    {"wall", true, wall}, {"block", true, block}, {"ball", true, ball}, {"beside", false, beside}};

/// The figures of a cell's runs.
struct Figures {
  unsigned runs = 0;
  unsigned contacts = 0;
  unsigned stops = 0;
  double stopped_at = 0;  ///< m/s, sum over the runs with a stop
  double clearance = 0;   ///< m, sum over the runs that end at something without a contact
  double seconds = 0;     ///< s, of driving, likewise or of the free way

  void add(const Figures& other) {
    runs += other.runs;
    contacts += other.contacts;
    stops += other.stops;
    stopped_at += other.stopped_at;
    clearance += other.clearance;
    seconds += other.seconds;
  }
};

double speed_at(const Judged& run, double t, double full) {
  const auto index = static_cast<std::size_t>(t / kTruthStep);
  const std::vector<double>& steps = run.history.progress;
  if (index + 1 >= steps.size()) return 0;
  return full * (steps[index + 1] - steps[index]) / kTruthStep;
}

// When it stands for good, or is past the free way; the end, if neither.
double done_at(const Judged& run, bool ends, double speed) {
  const std::vector<double>& steps = run.history.progress;
  const double goal = ends ? steps.back() - 0.01 / speed : 0.5 + kFreeWay / speed;
  const auto there = std::lower_bound(steps.begin(), steps.end(), goal);
  return kTruthStep * static_cast<double>(there - steps.begin());
}

Figures run_one(const Scene& scene, const Eyes& eyes, double speed, const Brake& brake, bool slows, unsigned seed,
                const Conditions& conditions, const Request& request) {
  Dice dice(seed);
  const host::TimedPose start = random_start(dice);
  Encounter met = scene.make(dice, start, speed);
  host::Scene seen = bare_scene(seed, conditions, eyes.lens, eyes.rate);
  seen.objects = met.scene.objects;
  met.scene = seen;
  met.obeys = true;
  met.slows = slows;
  met.brake = brake;
  const Judged run = run_cell(met, conditions);
  Figures figures;
  figures.runs = 1;
  const double clearance = [&] {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t o = 0; o < met.scene.objects.size(); ++o) {
      least = std::min(least, run.truth.clearance(o, run.history.end));
    }
    return least;
  }();
  const bool contact = run.history.end < met.seconds - kTruthStep / 2 || clearance < kTouching;
  figures.contacts = contact ? 1 : 0;
  for (const Stretch& stop : run.stops.all()) {
    if (stop.from < 0.5) continue;
    if (figures.stops++ == 0) figures.stopped_at = speed_at(run, stop.from, speed);
  }
  if (figures.stops > 0 && scene.ends) figures.stops = 1;
  if (!contact) {
    figures.clearance = clearance;
    figures.seconds = done_at(run, scene.ends, speed) - 0.5;
  }
  if (contact && request.show) {
    print(fmt::format("{} {} m/s, {} frames/s, {}: seed {} touches at {:.2f} s\n", scene.name, speed, eyes.rate,
                      slows ? "slows" : "stops", seed, run.history.end));
  }
  return figures;
}

bool run(const Request& request) {
  Conditions conditions;
  conditions.level = noise_levels({request.level}).front();
  conditions.profile = request.profile;
  for (const std::string& setting : request.settings) {
    const auto [key, value] = key_and_value(setting);
    conditions.settings.push_back({std::string_view(key), std::string_view(value)});
  }
  print(
      "| scene | m/s | brake | robot | runs | contacts | stops | at m/s | stands off, m | s |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n");
  Tally tally;
  for (const Scene& scene : kScenes) {
    if (!request.scene.empty() && request.scene != scene.name) continue;
    for (const double speed : kSpeeds) {
      for (const Brakes& brakes : kBrakes) {
        unsigned before = 0;
        for (const bool slows : {false, true}) {
          Figures all;
          for (const Eyes& eyes : kEyes) {
            for (const Figures& one : request.scenes.each([&](unsigned seed) {
                   return run_one(scene, eyes, speed, brakes.brake, slows, seed, conditions, request);
                 })) {
              all.add(one);
            }
          }
          const double whole = std::max(1U, all.runs - all.contacts);
          const std::string name = fmt::format("{}, {} m/s, {} brake", scene.name, speed, brakes.name);
          const bool quick_at_a_wall = scene.make == wall && brakes.brake.full < 1;
          const unsigned most = quick_at_a_wall ? 0 : before;
          const std::string_view mark = tally.look(!slows || all.contacts <= most, name + ": more contacts");
          before = all.contacts;
          const unsigned stopped = std::max(1U, scene.ends ? all.stops : all.runs);
          print(fmt::format("| {} | {} | {} | {} | {} | {}{} | {} | {:.2f} | {:.2f} | {:.1f} |\n", scene.name, speed,
                            brakes.name, slows ? "slows" : "stops", all.runs, all.contacts, mark, all.stops,
                            all.stopped_at / stopped, scene.ends ? all.clearance / whole : 0, all.seconds / whole));
        }
      }
    }
  }
  return tally.report(request.scenes) || !request.judge;
}

constexpr Study<Request> kStudy{
    "speed_study", "A robot that obeys the speed limit, beside one that obeys STOP alone.",
    [](CLI::App& app, Request& request) {
      add_seed_options(app, request.scenes, "runs for each lens, rate, speed, brake and robot", "--runs");
      add_profile_option(app, request.profile);
      app.add_option("--level", request.level, "of noise")->capture_default_str();
      app.add_option("--scene", request.scene, "one of them: wall, block, ball, beside");
      app.add_option("--set", request.settings, "KEY=VALUE, a setting of the robot");
      app.add_flag("--judge", request.judge,
                   "fail if a robot that slows down touches more often, or with quick motors a wall");
      app.add_flag("--show", request.show, "each run with a contact");
    },
    run};

}  // namespace
}  // namespace fencepost::test

int main(int argc, char** argv) { return fencepost::test::kStudy.main(argc, argv); }
