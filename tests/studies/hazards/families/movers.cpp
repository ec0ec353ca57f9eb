// Things that move by themselves, with and against the robot.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/geometry/rings.hpp"
#include "tests/studies/hazards/scenery.hpp"

namespace fencepost::test {
namespace {

constexpr double kBeyond = 1;       // m, a thing rolls on past the robot
constexpr double kAnnounced = 0.6;  // s, before the contact

// From `from` straight to `to` at that speed, starting at t.
std::vector<host::TimedPose> roll(double t, const host::TimedPose& from, const host::TimedPose& to, double speed) {
  const double seconds = std::hypot(to.x - from.x, to.y - from.y) / speed;
  return {{t, from.x, from.y, from.heading}, {t + seconds, to.x, to.y, from.heading}};
}

host::SceneObject ball(Dice& dice, const host::TimedPose& at) {
  const double radius = dice.between(0.03, 0.06);
  return thing("ball", random_colour(dice), 2 * radius, {host::circle_ring({at.x, at.y}, radius, 32), {}});
}

Outcome judge_mover(const Encounter& met, const Conditions& conditions) {
  Outcome outcome;
  const Judged run = run_cell(met, conditions);
  judge_contact(run, 0, outcome, kAnnounced);
  judge_false_stops(run, outcome);
  return outcome;
}

Outcome rolling_ball(double speed, unsigned seed, const Conditions& conditions) {
  Dice dice(seed);
  Encounter met;
  met.scene = bare_scene(seed, conditions);
  const host::TimedPose robot = random_start(dice);
  const double away = std::max(2.5, 2.5 * speed);
  const host::TimedPose toward = relative(robot, 0, 0, dice.between(-0.26, 0.26));
  const double aside = dice.between(-0.05, 0.05);
  const host::TimedPose from = relative(toward, away, aside);
  host::SceneObject object = ball(dice, from);
  object.path = roll(0, from, relative(toward, -kBeyond, aside), speed);
  met.scene.objects = {object};
  met.route = Route(robot, {});
  met.seconds = (away + kBeyond) / speed;
  return judge_mover(met, conditions);
}

Outcome oncoming_robot(unsigned seed, const Conditions& conditions) {
  constexpr double kSize = 0.2;  // m
  Dice dice(seed);
  Encounter met;
  met.scene = bare_scene(seed, conditions);
  const host::TimedPose robot = random_start(dice);
  const host::TimedPose from = relative(robot, 3, dice.between(-0.05, 0.05));
  host::SceneObject object = thing("robot", random_colour(dice), 0.15, box_at(from, kSize, kSize));
  object.path = roll(0, from, relative(from, -4, 0), dice.between(0.2, 0.4));
  met.scene.objects = {object};
  met.route = Route(robot, {{1, dice.between(0.1, 0.3), 0}});
  met.seconds = 15;
  return judge_mover(met, conditions);
}

Outcome leading_robot(unsigned seed, const Conditions& conditions) {
  constexpr double kGap = 0.54;    // m, from the robot's origin to the leader's tail
  constexpr double kSize = 0.2;    // m
  constexpr double kSeconds = 20;  // s, of driving
  Dice dice(seed);
  Encounter met;
  met.scene = bare_scene(seed, conditions);
  const host::TimedPose robot = random_start(dice);
  const host::TimedPose from = relative(robot, kGap + kSize / 2, dice.between(-0.02, 0.02));
  const double speed = dice.between(0.1, 0.3);
  host::SceneObject object = thing("leader", random_colour(dice), 0.15, box_at(from, kSize, kSize));
  object.path = roll(1, from, relative(from, speed * (kSeconds + 2), 0), speed);
  met.scene.objects = {object};
  met.route = Route(robot, {{1, 0, 0}, {1, speed, 0}});
  met.seconds = 1 + kSeconds;
  return meet_nothing(met, conditions);
}

// The ball passes ahead of the standing robot, which drives through there when it is gone.
Outcome crossing_ball(unsigned seed, const Conditions& conditions) {
  constexpr double kHalf = 1.5;  // m, on either side
  Dice dice(seed);
  Encounter met;
  met.scene = bare_scene(seed, conditions);
  const host::TimedPose robot = random_start(dice);
  const double ahead = dice.between(0.7, 1.2);
  const double side = dice.below(2) == 0 ? 1 : -1;
  const double speed = dice.between(0.3, 1.0);
  const host::TimedPose from = relative(robot, ahead, side * kHalf);
  host::SceneObject object = ball(dice, from);
  object.path = roll(0, from, relative(robot, ahead, -side * kHalf), speed);
  object.until = 2 * kHalf / speed;
  met.scene.objects = {object};
  const double own = dice.between(0.15, 0.3);
  met.route = Route(robot, {{2 * kHalf / speed, 0, 0}, {1, own, 0}});
  met.seconds = 2 * kHalf / speed + (ahead + 0.5) / own;
  Outcome outcome;
  const Judged run = run_cell(met, conditions);
  judge_false_stops(run, outcome);
  const auto ghosts = std::count_if(run.history.objects.begin(), run.history.objects.end(),
                                    [](const auto& of_map) { return of_map.state != record::ObjectState::kTentative; });
  ++outcome.asked;
  outcome.kept += run.stops.all().empty() && ghosts <= 1 ? 1U : 0U;
  outcome.measures.push_back(static_cast<double>(ghosts));
  if (ghosts > 1) outcome.failures.push_back(fmt::format("{} objects of one ball that is gone", ghosts));
  return outcome;
}

}  // namespace

Family movers() {
  Family family{
      "movers",
      "stop in force for the last 0.6 s before the contact; leader: none; crossing: none, and one object at most",
      "first stop, s before the contact; leader: stops; crossing: objects at the end",
      {}};
  for (const double speed : {0.3, 0.5, 1.0, 1.5}) {
    family.cells.push_back(
        {fmt::format("ball, {} m/s, at a standing robot", speed),
         {99, 1},
         [speed](unsigned seed, const Conditions& conditions) { return rolling_ball(speed, seed, conditions); }});
  }
  family.cells.push_back({"oncoming robot", {99, 1}, oncoming_robot});
  family.cells.push_back({"leader at equal speed, 0.54 m ahead", {99, 1}, leading_robot});
  family.cells.push_back({"ball that crosses and is gone", {99, 1}, crossing_ball});
  return family;
}

}  // namespace fencepost::test
