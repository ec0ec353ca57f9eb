// One encounter, simulated with a listener in the loop: an obedient robot stands when it says stop.
#pragma once

#include <string>
#include <vector>

#include "tests/studies/hazards/encounter.hpp"
#include "tests/studies/hazards/listener.hpp"

namespace fencepost::test {

/// Truth is sampled so often, s.
inline constexpr double kTruthStep = 0.01;

/// The events of a run, and all that was said.
struct History {
  double end = 0;                          ///< s
  std::vector<double> progress;            ///< s of the route, every kTruthStep up to the end
  std::vector<std::vector<double>> shown;  ///< [object], s, arrivals of the frames that showed it
  std::vector<record::AlertReport> alerts;
  std::vector<host::ObjectResult> objects;  ///< the map at the end
  std::vector<std::string> complaints;      ///< the listener's, about its input
};

/// errors: throws std::runtime_error with a sentence
History run_encounter(const Encounter& encounter, Listener& listener);

}  // namespace fencepost::test
