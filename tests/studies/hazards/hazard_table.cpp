// Prints how often alerts keep their promise, family by family, beside rules as users write them.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "tests/studies/hazards/reached.hpp"
#include "tests/studies/hazards/table.hpp"

namespace fencepost::test {
namespace {

struct Request {
  Seeds runs{100, kFirstJudgingSeed};
  std::vector<std::string> families;
  std::string scene;
  std::string level = "2";
  std::vector<std::string> rules;
  std::vector<std::string> settings;
  std::string profile = "full";
  double rate = 0;
  bool judge = false;
  std::string known;
  std::string written;
  bool show = false;
};

Conditions conditions_of(const Request& request) {
  Conditions conditions;
  conditions.profile = request.profile;
  if (request.rate > 0) conditions.rate = request.rate;
  for (const std::string_view setting : request.settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string_view::npos) throw std::runtime_error("--set takes KEY=VALUE");
    conditions.settings.push_back({setting.substr(0, equals), setting.substr(equals + 1)});
  }
  return conditions;
}

std::vector<Rule> rules_of(const Request& request) {
  std::vector<Rule> rules;
  for (const Rule rule : {Rule::kFencepost, Rule::kRange, Rule::kWidth}) {
    const auto& asked = request.rules;
    if (asked.empty() || std::find(asked.begin(), asked.end(), name(rule)) != asked.end()) rules.push_back(rule);
  }
  return rules;
}

Outcome run_all(const Cell& cell, const Conditions& conditions, const Request& request) {
  Outcome sum;
  for (unsigned i = 0; i < request.runs.scenes; ++i) {
    const unsigned seed = request.runs.first + i;
    const Outcome outcome = cell.run(seed, conditions);
    sum.add(outcome);
    if (!request.show) continue;
    for (const std::string& failure : outcome.failures) {
      print(fmt::format("    {} {} seed {}: {}\n", cell.scene, name(conditions.rule), seed, failure));
    }
  }
  return sum;
}

bool wanted(const Request& request, const Family& family) {
  return request.families.empty() ||
         std::find(request.families.begin(), request.families.end(), family.name) != request.families.end();
}

// The lines about cells that miss their targets.
class Misses {
 public:
  explicit Misses(const std::string& known) {
    if (!known.empty()) known_ = read_reached(known);
  }

  void take(const Family& family, const Cell& cell, const Outcome& sum) {
    const std::string miss = missed(cell.target, sum);
    const Reached now = reached(family, cell, sum);
    const Reached* before = find(known_, now);
    const std::string of = fmt::format("{}, {}: ", family.name, cell.scene);
    if (miss.empty()) {
      if (before != nullptr) said_ += "reached, and listed as missed: " + of + "take it off the list\n";
      return;
    }
    ++count_;
    said_ += "missed: " + of + miss + "\n";
    missed_.push_back(now);
    const std::string change = before == nullptr ? "never missed before" : worse(*before, now);
    if (change.empty()) return;
    ++grown_;
    said_ += "worse: " + of + change + "\n";
  }

  [[nodiscard]] const std::string& said() const { return said_; }
  [[nodiscard]] unsigned count() const { return count_; }
  /// More than is known.
  [[nodiscard]] unsigned grown() const { return grown_; }

  void write(const std::string& path) const {
    std::ofstream file(path);
    file << reached_head() << '\n';
    for (const Reached& cell : missed_) file << as_line(cell) << '\n';
    if (!file.flush()) throw std::runtime_error(path + ": cannot be written");
  }

 private:
  std::vector<Reached> known_;
  std::vector<Reached> missed_;
  std::string said_;
  unsigned count_ = 0;
  unsigned grown_ = 0;
};

bool run(const Request& request) {
  Conditions conditions = conditions_of(request);
  Misses misses(request.known);
  unsigned rows = 0;
  print(
      fmt::format("{} runs a cell, seeds from {} ({}; tuning 1 to {}, judging from {} on), profile {}, noise level {} "
                  "where a cell does not name its own\n",
                  request.runs.scenes, request.runs.first, use_of(request.runs), kLastTuningSeed, kFirstJudgingSeed,
                  request.profile, request.level));
  for (const Family& family : families()) {
    if (!wanted(request, family)) continue;
    print(head(family));
    for (const Cell& cell : family.cells) {
      if (cell.scene.find(request.scene) == std::string::npos) continue;
      conditions.level = noise_levels({cell.level.empty() ? request.level : cell.level}).front();
      for (const Rule rule : rules_of(request)) {
        conditions.rule = rule;
        const std::clock_t begin = std::clock();
        const Outcome sum = run_all(cell, conditions, request);
        const double took = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
        print(row(cell, rule, request.runs.scenes, sum, took));
        ++rows;
        if (rule == Rule::kFencepost) misses.take(family, cell, sum);
      }
    }
  }
  if (rows == 0) throw std::runtime_error("no cell has \"" + request.scene + "\" in its name");
  print("\n" + misses.said());
  print(fmt::format("{} rows, {} targets missed, {} more than known\n", rows, misses.count(), misses.grown()));
  if (!request.written.empty()) misses.write(request.written);
  return !request.judge || misses.grown() == 0;
}

void options(CLI::App& app, Request& request) {
  std::vector<std::string> names;
  for (const Family& family : families()) names.push_back(family.name);
  std::vector<std::string> keys;
  for (const NoiseLevel& level : noise_levels()) keys.emplace_back(level.key);
  add_seed_options(app, request.runs, "a cell and listener", "--runs");
  app.add_option("--family", request.families, "only these")->delimiter(',')->check(CLI::IsMember(names));
  app.add_option("--scene", request.scene, "only cells with this in their name");
  app.add_option("--level", request.level, "of noise, where a cell does not name its own")
      ->check(CLI::IsMember(keys))
      ->capture_default_str();
  app.add_option("--who", request.rules, "only these listeners; default: all")
      ->delimiter(',')
      ->check(CLI::IsMember({"fencepost", "range", "width"}));
  add_profile_option(app, request.profile);
  app.add_option("--rate", request.rate, "frames/s, in place of the cells' own")->check(CLI::PositiveNumber);
  app.add_option("--set", request.settings, "KEY=VALUE for the robot, not for its judge: plants a fault");
  app.add_flag("--judge", request.judge, "fail if Fencepost misses a target");
  app.add_option("--known", request.known, "a file of what cells reached that miss it: only worse ones fail")
      ->check(CLI::ExistingFile);
  app.add_option("--write-reached", request.written, "writes such a file");
  app.add_flag("--show", request.show, "tell of each failure by its seed");
}

constexpr Study<Request> kStudy = {"hazard_table", "What becomes of the alerts' promise, family by family", options,
                                   run};

}  // namespace
}  // namespace fencepost::test

int main(int argc, char** argv) { return fencepost::test::kStudy.main(argc, argv); }
