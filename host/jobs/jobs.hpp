// Independent pieces of work, several at once.
#pragma once

#include <cstddef>
#include <functional>

namespace fencepost::host {

/// As many as the machine has cores for this program.
std::size_t all_cores();

/// Calls `job` with 0, 1, ... count - 1, each once, in any order, at most `at_once` of them at a time. Of exceptions
/// one is thrown on; then not every job was called.
void run_jobs(std::size_t count, std::size_t at_once, const std::function<void(std::size_t)>& job);

}  // namespace fencepost::host
