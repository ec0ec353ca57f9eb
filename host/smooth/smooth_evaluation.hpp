// Online and optimum of one log against the truth: numbers alone.
#pragma once

#include <cstddef>
#include <string>

namespace fencepost::host {

/// A map against the true footprints.
struct TruthPar {
  std::size_t objects = 0;  ///< in the map, confirmed
  std::size_t pairs = 0;    ///< true objects that it has
  double as_it_stands = 0;  ///< m, rms of the places
  double aligned = 0;       ///< m, after the turn and shift that suit it best
  double worst = 0;         ///< m, of these
};

/// Both maps of one log.
struct SmoothEvaluation {
  std::string log;
  TruthPar online;
  TruthPar optimum;
};

}  // namespace fencepost::host
