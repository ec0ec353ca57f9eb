// The parts of the families' scenes.
#pragma once

#include "tests/studies/common/random_footprint.hpp"
#include "tests/studies/hazards/cell.hpp"

namespace fencepost::test {

struct Lens {
  double degrees = 43;   ///< of view, across 176 columns
  double height = 0.15;  ///< m
  double pitch = 0;      ///< rad, down
};

/// Camera of the published tables with that lens, four colours, the level's noise; 25 frames/s unless the conditions
/// says otherwise.
host::Scene bare_scene(unsigned seed, const Conditions& conditions, const Lens& lens = {}, double rate = 25);

/// Anywhere, any way round.
host::TimedPose random_start(Dice& dice);

/// One of the scene's colours.
std::uint8_t random_colour(Dice& dice);

/// A box around `center`, `depth` along its heading.
host::Polygon box_at(const host::TimedPose& center, double depth, double width);

/// Trained, on the floor.
host::SceneObject thing(std::string name, std::uint8_t colour, double height, host::Polygon footprint);
/// One of the shapes of the published tables, its nearest point `ahead` of `base` and to the left; `lowest` to 0.2 m
/// high.
host::SceneObject random_block(Dice& dice, const host::TimedPose& base, double ahead, double left, double lowest = 0.1);

/// A run with the conditions' listener.
Judged run_cell(const Encounter& encounter, const Conditions& conditions);

/// Is stationary for a moment, then drives straight on to the thing `ahead` at a random speed.
void drive_towards(Dice& dice, const host::TimedPose& start, double ahead, Encounter& encounter);

/// The outcome of an encounter in which nothing calls for a stop. Measures the number of stops.
Outcome meet_nothing(const Encounter& encounter, const Conditions& conditions);

}  // namespace fencepost::test
