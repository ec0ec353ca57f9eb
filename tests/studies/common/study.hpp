// Shared by the programs that study random scenes: their command lines, their seeds, how they print and end.
#pragma once

#include <CLI/CLI.hpp>

#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/studies/common/noise_levels.hpp"

namespace fencepost::test {

/// Random scenes by their seeds.
struct Seeds {
  unsigned scenes = 100;
  unsigned first = 1;

  /// The results of `run(seed)`, one for each seed.
  template <class Run>
  auto each(Run run) const {
    std::vector<decltype(run(first))> results;
    for (unsigned i = 0; i < scenes; ++i) results.push_back(run(first + i));
    return results;
  }
};

inline void add_seed_options(CLI::App& app, Seeds& seeds, const std::string& about,
                             const std::string& name = "--scenes") {
  app.add_option(name, seeds.scenes, about)->check(CLI::PositiveNumber)->capture_default_str();
  app.add_option("--first-seed", seeds.first,
                 "seed of the first one; which seeds tuned what: the READMEs of tests/studies")
      ->capture_default_str();
}

inline void add_levels_option(CLI::App& app, std::vector<std::string>& levels) {
  std::vector<std::string> keys;
  for (const NoiseLevel& level : noise_levels()) keys.emplace_back(level.key);
  app.add_option("--levels", levels, "of noise; default: all")->delimiter(',')->check(CLI::IsMember(keys));
}

inline void add_profile_option(CLI::App& app, std::string& profile) {
  app.add_option("--profile", profile, "capacities of the robot")->capture_default_str();
}

/// KEY and VALUE of an option --set KEY=VALUE.
inline std::pair<std::string, std::string> key_and_value(const std::string& setting) {
  const std::size_t equals = setting.find('=');
  if (equals == std::string::npos) throw std::runtime_error("--set " + setting + ": write KEY=VALUE");
  return {setting.substr(0, equals), setting.substr(equals + 1)};
}

/// On standard output at once: a study takes long, and is often piped.
inline void print(std::string_view text) {
  static_cast<void>(std::fwrite(text.data(), 1, text.size(), stdout));
  static_cast<void>(std::fflush(stdout));
}

/// Claims that were looked at, and those that do not hold.
struct Tally {
  std::size_t claims = 0;
  std::vector<std::string> broken;

  /// The mark behind the figure.
  std::string_view look(bool holds, const std::string& claim) {
    ++claims;
    if (!holds) broken.push_back(claim);
    return holds ? "" : " **";
  }
  /// The last lines; true if nothing is broken.
  bool report(const Seeds& seeds) const {
    for (const std::string& claim : broken) print("broken: " + claim + "\n");
    print(std::to_string(claims) + " claims, " + std::to_string(broken.size()) + " broken; " +
          std::to_string(seeds.scenes) + " scenes from seed " + std::to_string(seeds.first) + "\n");
    return broken.empty();
  }
};

/// A study's main(): `options` puts the command line's into a Request, `run` says whether all is as it has to be.
/// Status 0 or 1 by that, 2 for what it throws, said on standard error; the parser's own for a wrong command line.
template <class Request>
struct Study {
  const char* name;
  const char* about;
  void (*options)(CLI::App&, Request&);
  bool (*run)(const Request&);

  [[nodiscard]] int main(int argc, char** argv) const {
    try {
      Request request;
      CLI::App app(about, name);
      options(app, request);
      CLI11_PARSE(app, argc, argv);
      return run(request) ? 0 : 1;
    } catch (const std::exception& error) {
      static_cast<void>(std::fprintf(stderr, "%s: %s\n", name, error.what()));
      return 2;
    }
  }
};

}  // namespace fencepost::test
