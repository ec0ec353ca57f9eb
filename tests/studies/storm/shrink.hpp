// The shortest list of events with which a run still fails as it did.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tests/studies/storm/storm_run.hpp"

namespace fencepost::test {

/// The plan with the events of these numbers alone.
Plan with_events(const Plan& plan, const std::vector<std::size_t>& numbers);

/// Numbers of events of `plan`, which fails with `check`. Takes out halves, quarters and so on while it fails still, in
/// at most `runs` runs.
std::vector<std::size_t> shrunk(const Plan& plan, Plant plant, const std::string& check, int runs = 200);

/// The shell line that repeats it: `storm --seed 7 --minutes 10 --events 3,17`.
std::string command_of(const Plan& plan, const std::vector<std::size_t>& numbers);

}  // namespace fencepost::test
