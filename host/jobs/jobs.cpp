#include "host/jobs/jobs.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace fencepost::host {

std::size_t all_cores() { return std::max(1U, std::thread::hardware_concurrency()); }

void run_jobs(std::size_t count, std::size_t at_once, const std::function<void(std::size_t)>& job) {
  std::atomic<std::size_t> next = 0;
  std::mutex lock;
  std::exception_ptr first;
  const auto work = [&] {
    try {
      for (std::size_t i = next++; i < count; i = next++) job(i);
    } catch (...) {
      const std::lock_guard guard(lock);
      if (!first) first = std::current_exception();
      next = count;
    }
  };
  {
    std::vector<std::jthread> others;  // joined at the end of this block
    for (std::size_t i = 1; i < std::min(at_once, count); ++i) {
      try {
        others.emplace_back(work);
      } catch (const std::system_error&) {
        break;  // the system has no more threads: those that there are do it
      }
    }
    work();
  }
  if (first) std::rethrow_exception(first);
}

}  // namespace fencepost::host
