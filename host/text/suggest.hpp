// "Did you mean ...?"
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace fencepost::host {

/// The candidate with the fewest typing errors (swaps of neighbours count one) from `word`. Empty when none is near
/// enough to be more than a guess.
std::string nearest_word(std::string_view word, const std::vector<std::string>& candidates);

/// " did you mean pixy2?", or nothing: to be put behind a complaint.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace fencepost::host
