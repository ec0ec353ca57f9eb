// Runs every driver through hostile hours and prints the figures. Fails if one of them violates its limit.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cstdio>
#include <exception>
#include <string>

#include "tests/drivers/bench/comeback.hpp"
#include "tests/drivers/bench/hostile_hours.hpp"

namespace fencepost::test {
namespace {

bool run(const HostileCase& driver, double hours, unsigned seed) {
  const HostileFigures figures = run_hostile_hours(driver, hours, seed);
  fmt::print(
      "{:<20} {} h: {} samples; {} bytes damaged, {} faults; of {} good frames in calm {} lost, {} bytes damaged then; "
      "{} wrong samples, {} held back; longest gap {:.2f} s, recovery {:.2f} s; queue {}, heap {:+} bytes\n",
      driver.name, hours, figures.samples, figures.corrupted, figures.faults, figures.whole, figures.lost(),
      figures.corrupted_in_calm, figures.undetected, figures.held_back, figures.longest_gap.to_double(),
      figures.longest_recovery.to_double(), figures.longest_queue, figures.heap_growth);
  const auto faults = hostile_faults(figures, driver.limits);
  for (const std::string& fault : faults) fmt::print("  FAULT {}\n", fault);
  std::fflush(stdout);
  return faults.empty();
}

void show_recovery(const HostileCase& driver) {
  const Recovery recovery = measure_recovery(driver);
  fmt::print("{:<20} after a stall {:.2f} s, an unplug {:.2f} s, a power cycle {:.2f} s\n", driver.name,
             recovery.stall.to_double(), recovery.unplug.to_double(), recovery.power.to_double());
  if (const auto noise = hear_noise(driver)) {
    fmt::print("{:<20} of noise {} samples, {:.2f} % of the time it was said to work\n", driver.name, noise->samples,
               100.0 * static_cast<double>(noise->working) / static_cast<double>(noise->polls));
  }
  std::fflush(stdout);
}

int run_program(int argc, char** argv) {
  double hours = 24;
  unsigned seed = 1;
  std::string only;
  CLI::App app("Drivers on bad cables, for simulated hours");
  app.add_option("--hours", hours, "of the robot's clock, each driver")->capture_default_str();
  app.add_option("--seed", seed, "of damage and faults")->capture_default_str();
  app.add_option("--only", only, "drivers whose name begins so");
  bool silences = false;
  app.add_flag("--silences", silences, "instead: the longest recovery from silences on a good cable");
  CLI11_PARSE(app, argc, argv);
  bool good = true;
  bool any = false;
  for (const HostileCase& driver : hostile_cases()) {
    if (!driver.name.starts_with(only)) continue;
    any = true;
    if (silences) {
      show_recovery(driver);
      continue;
    }
    good = run(driver, hours, seed) && good;
  }
  return good && any ? 0 : 1;
}

}  // namespace
}  // namespace fencepost::test

int main(int argc, char** argv) {
  try {
    return fencepost::test::run_program(argc, argv);
  } catch (const std::exception& error) {
    static_cast<void>(std::fprintf(stderr, "hostile: %s\n", error.what()));
    return 2;
  }
}
