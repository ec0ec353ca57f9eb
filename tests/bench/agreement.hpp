// All that are measured have to give the same areas, or their times say nothing.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "tests/bench/contender.hpp"

namespace fencepost::bench {

/// Runs each once, and names the areas that are not those of the same wedges cut in double. The tolerance is 2e-4 of a
/// polygon's area, and the cells along its outline for a grid. Empty: all agree.
std::vector<std::string> disagreements(const Workload& workload, std::span<const Contender> contenders);

}  // namespace fencepost::bench
