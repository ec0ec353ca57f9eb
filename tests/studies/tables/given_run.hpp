// The models of the robot's objects, fed by hand: whose each blob is and which ends are hidden is given, not found.
#pragma once

#include <string>

#include "host/evaluate/evaluation.hpp"
#include "tests/studies/tables/tour.hpp"

namespace fencepost::test {

/// Each view of an object goes straight to recon::Object::track() and model(); the map's correspondence and its
/// occlusion flags have no part in it. Measured as host::evaluate measures a log, at kTableViews and at the last view.
/// errors: throws std::runtime_error for a profile that is not known.
host::Evaluation run_given(const Tour& tour, const std::string& profile);

}  // namespace fencepost::test
