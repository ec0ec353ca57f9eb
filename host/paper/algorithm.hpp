// The reconstructions that the figures compare: which model, and where its occlusion flags come from.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace fencepost::host {

struct Algorithm {
  std::string_view key;     ///< in CSV files
  std::string_view label;   ///< for people
  std::string_view model;   ///< of the result document
  bool inferred = false;    ///< from the log alone, as on the robot; else whose each blob is and which ends are hidden
                            ///< is given, as the paper's algorithms are always given it
  std::string_view colour;  ///< of lines and areas: #rrggbb
  std::string_view dash;    ///< stroke-dasharray; empty: solid
  std::optional<double> paper_red;  ///< the paper's accuracy for each landmark, %; nothing: not in the paper
  std::optional<double> paper_yellow;
  std::optional<double> paper_average;
};

/// Those whose models this build's full profile has. The paper's three come first, in its order.
const std::vector<Algorithm>& algorithms();

/// Index of the algorithm with that key; nothing if this build lacks it.
std::optional<std::size_t> algorithm_index(std::string_view key);

}  // namespace fencepost::host
