// The robot tracked objects with a wrong calibration. Here objects that are one are joined, and those without a place
// are left out.
#pragma once

#include <set>
#include <vector>

#include "host/calibrate/start.hpp"

namespace fencepost::host {

/// The times of each object's sightings.
std::vector<std::set<double>> times_of(const StartedProblem& started);

/// Every sighting of object i becomes one of object place[i], one of the same numbers; those with a place of kGone go,
/// with their objects.
inline constexpr std::size_t kGone = static_cast<std::size_t>(-1);
void renumber(StartedProblem& started, const std::vector<std::size_t>& place);

/// Objects of one signature at one place that no frame shows side by side become one.
void join_same(StartedProblem& started);

/// Ends that are predicted at the image's border go: those that noise puts inside are a choice of the noise.
void drop_at_border(StartedProblem& started);

/// Objects whose sightings do not fit any place go: they move, or are several. At least two stay.
void drop_unfit(StartedProblem& started);

}  // namespace fencepost::host
