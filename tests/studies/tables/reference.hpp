// The figures that the paper's algorithms reached in our prototype (reference.csv).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace fencepost::test {

inline constexpr unsigned kReferenceScenes = 100;

struct ReferenceCell {
  std::string level;  ///< key of a noise level
  std::string model;
  std::optional<std::uint32_t> views;  ///< nothing: the end of the tour
  double recklessness = 0;             ///< %
  double paranoia = 0;
};

/// Lines `level,model,views,recklessness,paranoia` after a line of exactly these names; `#` starts a comment line.
/// errors: throws std::runtime_error with file and line for what is not that, and for a file without a cell.
std::vector<ReferenceCell> load_reference(const std::string& path);

}  // namespace fencepost::test
