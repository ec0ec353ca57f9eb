// What the programs that study random scenes share on their command lines.
#pragma once

#include <CLI/CLI.hpp>

#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "tests/tables/noise_levels.hpp"

namespace fencepost::test {

inline void add_levels_option(CLI::App& app, std::vector<std::string>& levels) {
  std::vector<std::string> keys;
  for (const NoiseLevel& level : noise_levels()) keys.emplace_back(level.key);
  app.add_option("--levels", levels, "of noise; default: all")->delimiter(',')->check(CLI::IsMember(keys));
}

/// Status 2 for what a study throws, said on standard error.
template <class Run>
int run_study(const char* name, Run run, int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    static_cast<void>(std::fprintf(stderr, "%s: %s\n", name, error.what()));
    return 2;
  }
}

}  // namespace fencepost::test
