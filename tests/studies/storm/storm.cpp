// Robots in storms, many of them. Fails if anything that must never be has been, and says by which command it comes
// back.
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <numeric>

#include "tests/studies/common/study.hpp"
#include "tests/studies/storm/shrink.hpp"

namespace fencepost::test {
namespace {

struct Request {
  std::uint64_t seeds = 50;
  std::uint64_t first_seed = 1;
  double minutes = 10;
  unsigned jobs = 1;
  std::string events;  // numbers; empty: all
  std::string plant = "none";
  std::string log;
  bool shrink = true;
  bool tell = false;
  bool reboots = false;
};

constexpr std::string_view kPlants[] = {"none", "alert", "frame", "guard", "pin", "flash", "half"};

Plant plant_of(const std::string& name) {
  return static_cast<Plant>(std::find(std::begin(kPlants), std::end(kPlants), name) - std::begin(kPlants));
}

std::vector<std::size_t> chosen(const Plan& plan, const std::string& text) {
  std::vector<std::size_t> numbers;
  if (text == "none") return numbers;
  if (text.empty()) {
    numbers.resize(plan.events.size());
    std::iota(numbers.begin(), numbers.end(), std::size_t{0});
    return numbers;
  }
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    numbers.push_back(std::stoul(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  return numbers;
}

struct Sum {
  std::uint64_t runs = 0;
  std::uint64_t failed = 0;
  std::uint64_t frames = 0;
  std::uint64_t compared = 0;
  std::uint64_t alerts = 0;
  std::uint64_t stops = 0;
  std::uint64_t blind = 0;
  std::uint64_t dropped = 0;
  std::uint64_t power_cuts = 0;
  std::uint64_t events = 0;
  std::uint64_t log_bytes = 0;
};

void add(Sum& sum, const Plan& plan, const RunOutcome& outcome) {
  const RunFigures& figures = outcome.figures;
  ++sum.runs;
  sum.failed += outcome.faults.empty() ? 0U : 1U;
  sum.frames += figures.frames;
  sum.compared += figures.log.compared;
  sum.alerts += figures.log.alerts;
  sum.stops += figures.log.stops;
  sum.blind += figures.log.blind;
  sum.dropped += figures.dropped;
  sum.power_cuts += figures.power_cuts;
  sum.events += plan.events.size();
  sum.log_bytes += figures.log_bytes;
}

void report(const Request& request, const Plan& plan, const RunOutcome& outcome) {
  const std::vector<std::size_t> all = chosen(plan, request.events);
  print(fmt::format("seed {}: {}\n", plan.seed, describe(plan)));
  for (const Fault& fault : outcome.faults) print(fmt::format("  FAULT {}: {}\n", fault.check, fault.sentence));
  std::vector<std::size_t> numbers = all;
  if (request.shrink && request.events.empty()) {
    numbers = shrunk(plan, plant_of(request.plant), outcome.faults.front().check);
  }
  for (const std::size_t number : request.shrink ? numbers : std::vector<std::size_t>{}) {
    print(fmt::format("  event {}: {}\n", number, describe(plan.events.at(number))));
  }
  print(fmt::format("  again: {}{}{}\n", command_of(plan, numbers),
                    request.plant == "none" ? "" : " --plant " + request.plant, request.reboots ? " --reboots" : ""));
}

Sum run_share(const Request& request, unsigned job) {
  Sum sum;
  const auto began = std::chrono::steady_clock::now();
  for (std::uint64_t i = job; i < request.seeds; i += request.jobs) {
    Plan plan = plan_of(request.first_seed + i, request.minutes);
    if (request.reboots) plan.events = unnoticed_reboots(plan.seed, plan.milliseconds);
    const Plan used = with_events(plan, chosen(plan, request.events));
    if (request.tell) {
      print(fmt::format("seed {}: {}\n", plan.seed, describe(plan)));
      for (std::size_t n = 0; n < plan.events.size(); ++n)
        print(fmt::format("  event {}: {}\n", n, describe(plan.events[n])));
    }
    const RunOutcome outcome = run_storm(used, plant_of(request.plant));
    if (!request.log.empty()) std::ofstream(request.log) << outcome.text;
    add(sum, used, outcome);
    if (!outcome.faults.empty()) report(request, plan, outcome);
    if (sum.runs % 100 == 0) {
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
      print(fmt::format("job {}: {} runs, {} failed, {:.1f} s\n", job, sum.runs, sum.failed, seconds));
    }
  }
  return sum;
}

bool print_sum(const Request& request, const Sum& sum) {
  print(
      fmt::format("{} runs of {} minutes from seed {}: {} failed; {} events, {} power cuts, {} frames, {} alerts ({} "
                  "stops, {} blind), {} MB of logs, {} records compared, {} dropped and said so\n",
                  sum.runs, request.minutes, request.first_seed, sum.failed, sum.events, sum.power_cuts, sum.frames,
                  sum.alerts, sum.stops, sum.blind, sum.log_bytes / 1'000'000, sum.compared, sum.dropped));
  return sum.failed == 0 && sum.runs == request.seeds;
}

// A process each: no run can damage another's memory.
bool run(const Request& request) {
  if (request.jobs <= 1) return print_sum(request, run_share(request, 0));
  std::vector<std::pair<pid_t, int>> children;
  for (unsigned job = 0; job < request.jobs; ++job) {
    int ends[2];
    if (::pipe(ends) != 0) throw std::runtime_error("no pipe");
    const pid_t child = ::fork();
    if (child == 0) {
      const Sum sum = run_share(request, job);
      const bool written = ::write(ends[1], &sum, sizeof sum) == sizeof sum;
      ::_exit(written ? 0 : 1);
    }
    ::close(ends[1]);
    children.emplace_back(child, ends[0]);
  }
  Sum all;
  for (const auto& [child, end] : children) {
    Sum sum;
    const bool whole = ::read(end, &sum, sizeof sum) == sizeof sum;
    ::waitpid(child, nullptr, 0);
    if (!whole) print("a process ended before its runs did\n");
    if (!whole) continue;
    for (std::uint64_t Sum::*figure :
         {&Sum::runs, &Sum::failed, &Sum::frames, &Sum::compared, &Sum::alerts, &Sum::stops, &Sum::blind, &Sum::dropped,
          &Sum::power_cuts, &Sum::events, &Sum::log_bytes}) {
      all.*figure += sum.*figure;
    }
  }
  return print_sum(request, all);
}

void options(CLI::App& app, Request& request) {
  app.add_option("--seeds", request.seeds, "runs, each of its own seed")->capture_default_str();
  app.add_option("--first-seed", request.first_seed, "of the first run")->capture_default_str();
  app.add_option("--minutes", request.minutes, "of the robot's clock, of each run")->capture_default_str();
  app.add_option("--jobs", request.jobs, "processes")->capture_default_str();
  app.add_option("--events", request.events, "numbers of those that happen, with commas; none: none");
  app.add_option("--plant", request.plant, "a fault of ours: alert, frame, guard, pin, flash, half")
      ->capture_default_str();
  app.add_option("--log", request.log, "file for the log of the last run");
  app.add_flag("!--no-shrink", request.shrink, "say what failed, not the fewest events with which it does");
  app.add_flag("--reboots", request.reboots,
               "instead of all else camera and wheels are switched off and on while the loop is kept away");
  app.add_flag("--tell", request.tell, "each run and its events");
}

constexpr Study<Request> kStudy = {"storm", "Whole robots in storms of faults, each from one number", options, run};

}  // namespace
}  // namespace fencepost::test

int main(int argc, char** argv) { return fencepost::test::kStudy.main(argc, argv); }
