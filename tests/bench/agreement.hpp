// All that are measured have to give the same areas, or their times say nothing.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "tests/bench/contender.hpp"

namespace fencepost::bench {

/// Runs each once, and says which area is not that of the same wedges cut in double: of a polygon by more than 2e-4 of
/// it, of a grid by more than the cells along its outline. Empty: all agree.
std::vector<std::string> disagreements(const Workload& workload, std::span<const Contender> contenders);

}  // namespace fencepost::bench
