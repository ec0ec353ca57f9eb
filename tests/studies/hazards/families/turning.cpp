// Bodies that reach farther than half their width. The thing that they meet was seen before, and is beside or behind
// the robot when it counts. Or it is ahead, and nearer than the origin knows.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "firmware/config/settings.hpp"
#include "tests/studies/hazards/scenery.hpp"

namespace fencepost::test {
namespace {

constexpr double kWidth = 0.20;   // m
constexpr double kPost = 0.03;    // m, half its size
constexpr double kRadius = 0.25;  // m, of the tightest curve

// From the origin, m.
struct Reach {
  double front;
  double rear;
};
constexpr Reach kTail{0.08, 0.22};  // wheels at the front
constexpr Reach kNose{0.25, 0.06};  // wheels at the rear, as steered vehicles have them

// Those that the robot knows.
std::vector<record::Setting> footprint_settings(const Reach& reach) {
  std::vector<record::Setting> known;
  const auto add = [&](std::string_view key, double metres) {
    const record::Setting setting{key, std::string_view(fmt::format("{:.2f}", metres))};
    config::Settings settings;
    if (!settings.set(setting.key.view(), setting.value.view())) known.push_back(setting);
  };
  add("robot.front", reach.front);
  add("robot.rear", reach.rear);
  add("robot.width", kWidth);
  return known;
}

Encounter with_body(const Reach& reach, unsigned seed, const Conditions& conditions) {
  Encounter met;
  met.scene = bare_scene(seed, conditions);
  met.body = Body::box(reach.front, reach.rear, kWidth);
  met.settings = footprint_settings(reach);
  return met;
}

Outcome judge_body(const Encounter& met, const Conditions& conditions) {
  Outcome outcome;
  const Judged run = run_cell(met, conditions);
  judge_contact(run, 0, outcome);
  judge_false_stops(run, outcome);
  return outcome;
}

// Straight into a block with a long nose.
Outcome drive_nose(unsigned seed, const Conditions& conditions) {
  Dice dice(seed);
  Encounter met = with_body(kNose, seed, conditions);
  const host::TimedPose start = random_start(dice);
  const double ahead = dice.between(1.0, 1.4);
  met.scene.objects = {random_block(dice, start, ahead, dice.between(-0.05, 0.05))};
  const double speed = dice.between(0.1, 0.4);
  met.route = Route(start, {{0.5, 0, 0}, {1, speed, 0}});
  met.seconds = 0.5 + ahead / speed;
  return judge_body(met, conditions);
}

// Drives up to a block, turns round and backs into it.
Encounter back_into_block(unsigned seed, const Conditions& conditions) {
  Dice dice(seed);
  Encounter met = with_body(kTail, seed, conditions);
  const host::TimedPose start = random_start(dice);
  const double ahead = dice.between(1.2, 1.6);
  met.scene.objects = {random_block(dice, start, ahead, dice.between(-0.05, 0.05))};
  const double turn_rate = dice.below(2) == 0 ? 1.5 : -1.5;
  const double back = dice.between(0.1, 0.25);
  met.route = Route(start, {{0.5, 0, 0}, {2, 0.2, 0}, {std::numbers::pi / 1.5, 0, turn_rate}, {1, -back, 0}});
  met.seconds = met.route.last_leg() + (ahead - 0.4) / back;
  return met;
}

Outcome reverse(unsigned seed, const Conditions& conditions) {
  return judge_body(back_into_block(seed, conditions), conditions);
}

// It stands when it hears stop, ten seconds long, with the block behind it.
Outcome reverse_and_obey(unsigned seed, const Conditions& conditions) {
  constexpr double kWithin = 0.36;  // m of the origin
  Encounter met = back_into_block(seed, conditions);
  met.obeys = true;
  met.seconds += 10;
  Outcome outcome;
  const Judged run = run_cell(met, conditions);
  judge_silence(run, 0, kWithin, outcome);
  judge_false_stops(run, outcome);
  return outcome;
}

// Drives 0.8 m and turns then; a post, seen ahead before, stands `ahead` and `left` of where it turns (m).
struct Turn {
  double ahead = 0;
  double left = 0;
  double radius = 0;  ///< m, positive: to the left
  double rate = 0;    ///< rad/s, on the spot, where there is no radius
  bool back = false;  ///< reversing
};

Encounter turn_by_post(const Reach& reach, const Turn& turn, Dice& dice, unsigned seed, const Conditions& conditions) {
  constexpr double kDrive = 0.8;  // m
  Encounter met = with_body(reach, seed, conditions);
  const host::TimedPose start = random_start(dice);
  const host::TimedPose post = relative(start, kDrive + turn.ahead, turn.left);
  const double height = dice.between(0.1, 0.2);
  met.scene.objects = {thing("post", random_colour(dice), height, box_at(post, 2 * kPost, 2 * kPost))};
  const double speed = dice.between(0.1, 0.3);
  const double last_speed = turn.back ? -speed : speed;
  const Leg last = turn.radius != 0 ? Leg{1, last_speed, last_speed / turn.radius} : Leg{1, 0, turn.rate};
  met.route = Route(start, {{0.5, 0, 0}, {kDrive / speed, speed, 0}, last});
  met.seconds = met.route.last_leg() + std::numbers::pi / std::abs(last.turn_rate);
  return met;
}

double random_side(Dice& dice) { return dice.below(2) == 0 ? 1 : -1; }

// The tail goes to the left when the robot turns to the right.
Outcome spin(unsigned seed, const Conditions& conditions) {
  Dice dice(seed);
  const double side = random_side(dice);
  const double gap = dice.between(0.02, 0.06);
  const double rate = -side * dice.between(0.5, 1.0);
  const double behind = dice.between(0.13, 0.17);
  const Turn turn{-behind, side * (kWidth / 2 + gap + kPost), 0, rate};
  return judge_body(turn_by_post(kTail, turn, dice, seed, conditions), conditions);
}

// Its tightest curve: the tail swings out by sqrt(0.35^2 + 0.22^2) - 0.35 = 6 cm.
Outcome swing_tail(unsigned seed, const Conditions& conditions) {
  Dice dice(seed);
  const double side = random_side(dice);
  const double gap = dice.between(0.01, 0.03);
  const double behind = dice.between(0.13, 0.17);
  const Turn turn{-behind, side * (kWidth / 2 + gap + kPost), -side * kRadius};
  return judge_body(turn_by_post(kTail, turn, dice, seed, conditions), conditions);
}

// The nose's outer corner goes along a circle of sqrt(0.35^2 + 0.25^2) = 0.43 m, 8 cm outside of the wheels' side.
Outcome swing_nose(unsigned seed, const Conditions& conditions) {
  Dice dice(seed);
  const double side = random_side(dice);
  const double corner = std::hypot(kRadius + kWidth / 2, kNose.front);
  const double radius = corner - dice.between(0.01, 0.05) + kPost;
  const double along = dice.between(0.9, 1.4);  // rad of the curve
  const Turn turn{radius * std::sin(along), side * (kRadius - radius * std::cos(along)), side * kRadius, 0};
  return judge_body(turn_by_post(kNose, turn, dice, seed, conditions), conditions);
}

// Backs off on its tightest curve: now the nose swings out, by sqrt(0.35^2 + 0.25^2) - 0.35 = 8 cm.
Outcome swing_back(unsigned seed, const Conditions& conditions) {
  Dice dice(seed);
  const double side = random_side(dice);
  const double gap = dice.between(0.01, 0.03);
  const double ahead = dice.between(0.16, 0.20);
  const Turn turn{ahead, side * (kWidth / 2 + gap + kPost), -side * kRadius, 0, true};
  return judge_body(turn_by_post(kNose, turn, dice, seed, conditions), conditions);
}

// The same turns beside a post that no corner reaches, not even with its margin and the grazes: no stop is due.
Outcome turn_freely(const Turn& turn, Dice& dice, unsigned seed, const Conditions& conditions) {
  const Encounter met = turn_by_post(kTail, turn, dice, seed, conditions);
  Outcome outcome;
  const Judged run = run_cell(met, conditions);
  judge_no_stop(run, outcome);
  judge_false_stops(run, outcome);
  outcome.measures.push_back(outcome.false_stops);
  return outcome;
}

Outcome spin_freely(unsigned seed, const Conditions& conditions) {
  Dice dice(seed);
  const double side = random_side(dice);
  const double gap = dice.between(0.32, 0.45);
  const double rate = -side * dice.between(0.5, 1.0);
  return turn_freely({-dice.between(0, 0.2), side * (kWidth / 2 + gap + kPost), 0, rate}, dice, seed, conditions);
}

Outcome swing_freely(unsigned seed, const Conditions& conditions) {
  Dice dice(seed);
  const double side = random_side(dice);
  const double gap = dice.between(0.16, 0.25);
  const Turn turn{-dice.between(0, 0.2), side * (kWidth / 2 + gap + kPost), -side * kRadius};
  return turn_freely(turn, dice, seed, conditions);
}

}  // namespace

Family turning() {
  return {"turning",
          "stop in force for the last 0.5 s before the contact of a body that is configured as robot.front, .rear and "
          ".width; "
          "no stop where nothing is reached",
          "first stop, s before the contact",
          {{"backing into a block after a turn of 180 degrees", {95, 1}, reverse},
           {"the same, and the robot obeys: no contact, never clear before it", {95, 1}, reverse_and_obey},
           {"spinning on the spot, a post beside the tail", {95, 1}, spin},
           {"tight curve, a post beside the tail that swings out", {95, 1}, swing_tail},
           {"a nose of 0.25 m, straight into a block", {95, 1}, drive_nose},
           {"tight curve, a post before the nose's outer corner", {95, 1}, swing_nose},
           {"backing off on a tight curve, a post beside the nose that swings out", {95, 1}, swing_back},
           {"spinning on the spot, a post out of reach: no stop", {95, 1}, spin_freely},
           {"tight curve, a post that the tail does not reach: no stop", {95, 1}, swing_freely}}};
}

}  // namespace fencepost::test
