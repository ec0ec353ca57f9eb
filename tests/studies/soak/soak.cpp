// Drives for simulated hours and prints the figures. Fails if a rule that must always hold was broken.
#include <fmt/format.h>

#include <cstdio>

#include "tests/studies/common/study.hpp"
#include "tests/studies/soak/soak_run.hpp"

namespace fencepost::test {
namespace {

constexpr double kRoundsAnHour = 3600 / 30.0;

void print_lap(const char* where, const LapQuality& lap) {
  fmt::print("  lap {:<10} {} of 3 found, centres {:.1f} mm off, R {:.1f} %, P {:.1f} %\n", where, lap.found,
             1000 * lap.center_error, 100 * lap.recklessness, 100 * lap.paranoia);
}

bool drive(const std::string& profile, double hours, unsigned seed) {
  const SoakFigures figures = run_soak(profile, static_cast<unsigned>(hours * kRoundsAnHour) + 3, seed);
  fmt::print("profile {}: {:.2f} h, {} frames came, {} used, {} refused, {} commands typed\n", profile,
             figures.minutes / 60, figures.frames_offered, figures.frames_used, figures.frames_refused,
             figures.commands);
  fmt::print("  {} runs replayed, {} records compared; frame counter wrapped: {}, clock's low word: {}\n",
             figures.runs_replayed, figures.digests_compared, figures.frame_counter_wrapped,
             figures.clock_word_wrapped);
  print_lap("at start", figures.at_start);
  print_lap("100 m away", figures.far_away);
  print_lap("at the end", figures.at_end);
  fmt::print("  after two changes of the blocks without a reset {} of {} are in the map\n", figures.present_found,
             figures.present);
  for (const std::string& fault : figures.faults) fmt::print("  FAULT {}\n", fault);
  std::fflush(stdout);
  return figures.faults.empty();
}

struct Request {
  double hours = 24;
  unsigned seed = 1;
  std::vector<std::string> profiles{"micro", "small", "full"};
};

bool run(const Request& request) {
  bool good = true;
  for (const std::string& profile : request.profiles) good = drive(profile, request.hours, request.seed) && good;
  return good;
}

void options(CLI::App& app, Request& request) {
  app.add_option("--hours", request.hours, "of the robot's clock, about")->capture_default_str();
  app.add_option("--seed", request.seed, "of blocks and commands")->capture_default_str();
  app.add_option("--profiles", request.profiles, "of micro,small,full")->delimiter(',');
}

constexpr Study<Request> kStudy = {"soak", "A robot drives for simulated hours", options, run};

}  // namespace
}  // namespace fencepost::test

int main(int argc, char** argv) { return fencepost::test::kStudy.main(argc, argv); }
