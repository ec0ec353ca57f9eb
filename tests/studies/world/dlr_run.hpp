// Windows of DLR's drive through the product: how far the sightings of one disc scatter in the map.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace fencepost::test {

/// m, one a window: mean over discs of the mean distance of their sightings from the median place.
/// Throws std::runtime_error if the file cannot be read.
std::vector<double> run_dlr(const std::string& file, std::size_t steps, bool identity,
                            const std::vector<std::pair<std::string, std::string>>& settings);
/// The same by a textbook filter, with a signature for each disc: `import_dlr` has 31, then discs share them.
std::vector<double> run_dlr_by_textbook(const std::string& file, std::size_t steps);

}  // namespace fencepost::test
