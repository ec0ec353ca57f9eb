#include "host/jobs/jobs.hpp"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace fencepost::host {

std::size_t all_cores() { return static_cast<std::size_t>(tbb::info::default_concurrency()); }

void run_jobs(std::size_t count, std::size_t at_once, const std::function<void(std::size_t)>& job) {
  at_once = std::min(at_once, std::max<std::size_t>(count, 1));
  // Without leave the library takes no more than there are cores.
  const tbb::global_control leave(tbb::global_control::max_allowed_parallelism, at_once);
  tbb::task_arena arena(static_cast<int>(at_once));
  arena.execute([&] {
    const auto some = [&](const tbb::blocked_range<std::size_t>& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) job(i);
    };
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count), some, tbb::simple_partitioner());
  });
}

}  // namespace fencepost::host
