// Which box is of which object, asked again when poses and places are better known than they were online.
#pragma once

#include <cstddef>

#include "host/calibrate/solver.hpp"
#include "host/calibrate/start.hpp"

namespace fencepost::host {

struct Reassigned {
  std::size_t added = 0;       ///< boxes that no object had
  std::size_t moved = 0;       ///< from one object to another of its colour
  std::size_t taken_back = 0;  ///< that fit no object
};

/// A box that no longer fits its object goes to the object of its signature that it fits, else to the spare boxes.
/// Spare boxes that fit an object are taken. No object gets two boxes of a frame.
Reassigned reassign(StartedProblem& started);

/// Objects of one signature that no frame shows side by side become one if one place fits the sightings as well as two.
/// It is a likelihood-ratio test, pair by pair, nearest first. Answers how many objects went.
std::size_t join_by_test(StartedProblem& started, const SolverOptions& options);

/// Objects whose sightings fit no place (they move, or are several), or of which fewer than `least` are left, go; their
/// boxes become spare. Answers how many.
std::size_t drop_lost(StartedProblem& started, std::size_t least);

}  // namespace fencepost::host
