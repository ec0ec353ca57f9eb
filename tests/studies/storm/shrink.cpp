#include "tests/studies/storm/shrink.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

namespace fencepost::test {

Plan with_events(const Plan& plan, const std::vector<std::size_t>& numbers) {
  Plan fewer = plan;
  fewer.events.clear();
  for (const std::size_t number : numbers) fewer.events.push_back(plan.events.at(number));
  return fewer;
}

std::vector<std::size_t> shrunk(const Plan& plan, Plant plant, const std::string& check, int runs) {
  const auto fails = [&](const std::vector<std::size_t>& numbers) {
    const RunOutcome outcome = run_storm(with_events(plan, numbers), plant);
    return std::any_of(outcome.faults.begin(), outcome.faults.end(),
                       [&](const Fault& fault) { return fault.check == check; });
  };
  std::vector<std::size_t> numbers(plan.events.size());
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  std::size_t portion = numbers.size();
  while (portion > 0 && runs > 0) {
    bool fewer = false;
    for (std::size_t begin = 0; begin < numbers.size() && runs > 0;) {
      std::vector<std::size_t> rest = numbers;
      const std::size_t end = std::min(begin + portion, rest.size());
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(begin), rest.begin() + static_cast<std::ptrdiff_t>(end));
      --runs;
      if (fails(rest)) {
        numbers = rest;
        fewer = true;
      } else {
        begin = end;
      }
    }
    if (portion > 1 || !fewer) portion /= 2;
  }
  return numbers;
}

std::string command_of(const Plan& plan, const std::vector<std::size_t>& numbers) {
  std::string command = fmt::format("storm --first-seed {} --seeds 1 --minutes {}", plan.seed,
                                    static_cast<double>(plan.milliseconds) / 60'000);
  if (numbers.size() == plan.events.size()) return command;
  return command + " --events " + (numbers.empty() ? "none" : fmt::format("{}", fmt::join(numbers, ",")));
}

}  // namespace fencepost::test
