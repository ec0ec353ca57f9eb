#include "tests/drivers/bench/hostile_figures.hpp"

#include <malloc.h>

namespace fencepost::test {
namespace {

constexpr std::size_t kLongestQueue = 6'000;     // bytes: half a second of the line
constexpr std::int64_t kHeapSlack = 256 * 1024;  // the C library's own

}  // namespace

std::uint64_t heap_in_use() { return ::mallinfo2().uordblks; }

std::vector<std::string> hostile_faults(const HostileFigures& figures, const HostileLimits& limits) {
  std::vector<std::string> faults;
  const auto check = [&](bool good, const char* sentence) {
    if (!good) faults.emplace_back(sentence);
  };
  const double samples = static_cast<double>(figures.samples);
  check(samples >= static_cast<double>(limits.least_samples) * figures.hours, "too few samples came");
  check(figures.faults > 100 * figures.hours, "too few faults were made to say anything");
  check(static_cast<double>(figures.corrupted) > 1'000 * figures.hours, "too few bytes were damaged to say anything");
  // A frame that was on its way at a fault's beginning is not the damage's.
  check(figures.lost() <= figures.corrupted_in_calm + 2 * figures.faults, "a damaged byte cost more than a good frame");
  check(static_cast<double>(figures.undetected) <= limits.undetected_share * samples, "too much damage went unnoticed");
  check(figures.disorder == 0, "samples came out of order");
  check(figures.longest_gap <= limits.longest_wait, "it hung between faults");
  check(figures.longest_recovery <= limits.longest_wait, "it hung after a fault");
  check(figures.longest_queue <= kLongestQueue, "bytes waited without end");
  check(figures.heap_growth <= kHeapSlack, "the program grew");
  return faults;
}

}  // namespace fencepost::test
