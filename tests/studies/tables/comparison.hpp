// Measured means beside the reference's.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "host/evaluate/evaluation.hpp"
#include "tests/studies/tables/reference.hpp"

namespace fencepost::test {

inline constexpr double kPointsAllowed = 2;  ///< %, maximum by which R + P may be worse
inline constexpr double kErrorsAllowed = 2;  ///< standard errors, by which it may be worse on top before a cell fails

struct ComparedCell {
  ReferenceCell reference;
  double recklessness = 0;  ///< %
  double paranoia = 0;
  double error = 0;  ///< standard error of the difference of both R + P, %

  [[nodiscard]] double worse_by() const {
    return recklessness + paranoia - reference.recklessness - reference.paranoia;
  }
  [[nodiscard]] bool misses() const { return worse_by() > kPointsAllowed; }
  /// Not by chance.
  [[nodiscard]] bool fails() const { return worse_by() > kPointsAllowed + kErrorsAllowed * error; }
};

/// Mean paranoia in which an empty model counts 1, as in the reference.
double paranoia_with_empty(const host::SummaryRow& row);

/// Every cell of the level. Objects of one scene share poses and hide each other, so the standard error is that of
/// scenes, not of objects. The reference's own was not kept; its scenes are as ours, so it follows from their number.
/// errors: throws std::runtime_error for fewer than two scenes and for a model that was not measured.
std::vector<ComparedCell> compare(std::string_view level, std::span<const host::Evaluation> scenes,
                                  std::span<const ReferenceCell> reference);

}  // namespace fencepost::test
