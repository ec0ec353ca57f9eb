#include "tests/studies/hazards/reached.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace fencepost::test {
namespace {

constexpr char kSeparator = ';';  // names of scenes have commas
constexpr double kErrors = 3;

double share(unsigned part, unsigned whole) { return whole > 0 ? static_cast<double>(part) / whole : 0; }

// The standard error of the difference of two shares, and of two rates, if both are the same but for chance.
double error_of_shares(const Reached& a, const Reached& b) {
  if (a.asked == 0 || b.asked == 0) return 0;
  const double p = share(a.kept + b.kept, a.asked + b.asked);
  return std::sqrt(p * (1 - p) * (1.0 / a.asked + 1.0 / b.asked));
}
double error_of_rates(const Reached& a, const Reached& b) {
  if (a.seconds <= 0 || b.seconds <= 0) return 0;
  const double rate = (a.false_stops + b.false_stops) / (a.seconds + b.seconds);
  return std::sqrt(rate / a.seconds + rate / b.seconds);
}

double in_ten_minutes(double rate) { return 600 * rate; }

Reached parse(const std::string& line) {
  std::istringstream fields(line);
  Reached reached;
  char separator = 0;
  std::getline(fields, reached.family, kSeparator);
  std::getline(fields, reached.scene, kSeparator);
  fields >> reached.asked >> separator >> reached.kept >> separator >> reached.seconds >> separator >>
      reached.false_stops;
  if (!fields || reached.kept > reached.asked) throw std::runtime_error("not a row of " + reached_head());
  return reached;
}

}  // namespace

Reached reached(const Family& family, const Cell& cell, const Outcome& sum) {
  return {family.name, cell.scene, sum.asked, sum.kept, sum.seconds, sum.false_stops - sum.grazes};
}

std::string reached_head() { return "family;scene;asked;kept;seconds;false_stops"; }

std::string as_line(const Reached& reached) {
  return fmt::format("{};{};{};{};{:.1f};{}", reached.family, reached.scene, reached.asked, reached.kept,
                     reached.seconds, reached.false_stops);
}

std::vector<Reached> read_reached(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line) || line != reached_head()) {
    throw std::runtime_error(path + ": not a table of what was reached; --write-reached makes one");
  }
  std::vector<Reached> all;
  for (unsigned number = 2; std::getline(file, line); ++number) {
    try {
      all.push_back(parse(line));
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(fmt::format("{}:{}: {}", path, number, error.what()));
    }
  }
  return all;
}

const Reached* find(const std::vector<Reached>& all, const Reached& like) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const Reached& reached) {
    return reached.family == like.family && reached.scene == like.scene;
  });
  return found == all.end() ? nullptr : &*found;
}

std::string worse(const Reached& before, const Reached& now) {
  std::string text;
  const double kept = share(now.kept, now.asked);
  const double kept_before = share(before.kept, before.asked);
  if (kept < kept_before - kErrors * error_of_shares(before, now)) {
    text = fmt::format("{:.1f} % kept, {:.1f} % before", 100 * kept, 100 * kept_before);
  }
  const double rate = now.seconds > 0 ? now.false_stops / now.seconds : 0;
  const double rate_before = before.seconds > 0 ? before.false_stops / before.seconds : 0;
  if (rate > rate_before + kErrors * error_of_rates(before, now)) {
    text += fmt::format("{}{:.2f} false stops in 10 min, {:.2f} before", text.empty() ? "" : "; ", in_ten_minutes(rate),
                        in_ten_minutes(rate_before));
  }
  return text;
}

}  // namespace fencepost::test
