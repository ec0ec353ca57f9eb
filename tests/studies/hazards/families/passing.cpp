// Things that need no stop: two boxes that the robot passes between, and two rows of six. In rows of one colour boxes
// join in the image, so there are also rows in which neighbours differ. A plate on the floor, flat as a sheet of paper.
#include <fmt/format.h>

#include <iterator>

#include "tests/studies/hazards/scenery.hpp"

namespace fencepost::test {
namespace {

constexpr double kApart = 0.5;  // m, from one box of a row to the next

// Any speed and any rate of frames.
Outcome pass(int pairs, bool one_colour, double degrees, unsigned seed, const Conditions& conditions) {
  constexpr double kRates[] = {5, 10, 25, 50};  // frames/s
  Dice dice(seed);
  Encounter met;
  const double rate = kRates[dice.below(static_cast<int>(std::size(kRates)))];
  met.scene = bare_scene(seed, conditions, {.degrees = degrees}, rate);
  const host::TimedPose start = random_start(dice);
  const std::uint8_t colour = random_colour(dice);
  const auto colour_of = [&](int pair, double side) {
    return one_colour ? colour : static_cast<std::uint8_t>(1 + 2 * (pair % 2) + (side > 0 ? 1 : 0));
  };
  const double speed = dice.between(0.1, 0.6);
  const double first = dice.between(1.0, 1.5);
  for (int pair = 0; pair < pairs; ++pair) {
    for (const double side : {-1.0, 1.0}) {
      const double depth = dice.between(0.05, 0.2);
      const double width = dice.between(0.05, 0.2);
      const double gap = dice.between(0.03, 0.1);  // beyond robot.margin
      const double aside = AlertLimits{}.half_width + AlertLimits{}.margin + gap + width / 2;
      const host::TimedPose center = relative(start, first + kApart * pair, side * aside);
      met.scene.objects.push_back(
          thing("box", colour_of(pair, side), dice.between(0.1, 0.3), box_at(center, depth, width)));
    }
  }
  constexpr double kStands = 0.5;  // s
  const double way = first + kApart * (pairs - 1) + 0.3;
  met.route = Route(start, {{kStands, 0, 0}, {1, speed, 0}});
  met.seconds = kStands + way / speed;
  return meet_nothing(met, conditions);
}

// To a camera of boxes a flat thing is a low one.
Outcome drive_over(double degrees, unsigned seed, const Conditions& conditions) {
  Dice dice(seed);
  Encounter met;
  met.scene = bare_scene(seed, conditions, {.degrees = degrees});
  const host::TimedPose start = random_start(dice);
  const double ahead = dice.between(1.0, 1.5);
  const host::TimedPose center = relative(start, ahead, dice.between(-0.1, 0.1));
  constexpr double kPaper = 0.001;  // m
  met.scene.objects = {
      thing("plate", random_colour(dice), kPaper, box_at(center, dice.between(0.1, 0.3), dice.between(0.1, 0.3)))};
  const double speed = dice.between(0.1, 0.6);
  constexpr double kStands = 0.5;  // s
  met.route = Route(start, {{kStands, 0, 0}, {1, speed, 0}});
  met.seconds = kStands + (ahead + 0.3) / speed;
  return meet_nothing(met, conditions);
}

}  // namespace

Family passing() {
  Family family{"passing",
                "no stop between boxes 3 to 10 cm beyond the margin, nor for a plate on the floor, and no complaint; "
                "0.1 to 0.6 m/s, "
                "5 to 50 frames/s",
                "stops a run",
                {}};
  struct Rows {
    std::string_view name;
    int pairs;
    bool one_colour;
  };
  for (const Rows& rows : {Rows{"two boxes", 1, true}, Rows{"two rows of six", 6, true},
                           Rows{"two rows of six, four colours", 6, false}}) {
    for (const double degrees : {43.0, 60.0, 80.0}) {
      family.cells.push_back({fmt::format("{}, {} degrees", rows.name, degrees),
                              {95, {}},
                              [rows, degrees](unsigned seed, const Conditions& conditions) {
                                return pass(rows.pairs, rows.one_colour, degrees, seed, conditions);
                              }});
    }
  }
  family.cells.push_back(
      {"a flat plate in the path, 60 degrees", {95, {}}, [](unsigned seed, const Conditions& conditions) {
         return drive_over(60, seed, conditions);
       }});
  return family;
}

}  // namespace fencepost::test
