// The tables as Markdown.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "host/evaluate/evaluation.hpp"
#include "tests/studies/common/noise_levels.hpp"
#include "tests/studies/tables/comparison.hpp"

namespace fencepost::test {

/// The cells compared under one kind of flags ("true", "inferred"): those of a level, or all of them.
struct Compared {
  std::string flags;
  std::vector<ComparedCell> cells;
};

/// R / P / IoU of every model, in %.
std::string level_table(const NoiseLevel& level, const std::string& flags, const host::Summary& summary);

/// R / P of the reference, and under it those of each kind of flags, all with the same cells.
std::string comparison_table(const NoiseLevel& level, std::span<const Compared> compared);

/// Every cell that is worse than allowed, and the counts.
std::string verdict(const Compared& compared);

}  // namespace fencepost::test
