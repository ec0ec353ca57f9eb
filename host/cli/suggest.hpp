// "Did you mean ...?"
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace fencepost::host::cli {

/// The candidate with the fewest typing errors (swaps of neighbours count one) from `word`; empty when none is near
/// enough to be a guess rather than noise.
std::string nearest_word(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace fencepost::host::cli
