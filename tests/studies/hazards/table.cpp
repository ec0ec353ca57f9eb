#include "tests/studies/hazards/table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace fencepost::test {
namespace {

std::string text_of(const Target& target) {
  std::string text;
  if (target.kept) text += fmt::format("{} %", *target.kept);
  if (target.false_stops) text += fmt::format("{}{} false", text.empty() ? "" : ", ", *target.false_stops);
  return text;
}

}  // namespace

std::string_view use_of(const Seeds& seeds) {
  if (seeds.first >= kFirstJudgingSeed) return "judging";
  return seeds.first + seeds.scenes - 1 <= kLastTuningSeed ? "tuning" : "neither tuning nor judging";
}

std::string head(const Family& family) {
  return fmt::format(
      "\n## {}\nKept: {}. Measure: {}.\n\n"
      "| scene | who | runs | kept, % | of | median measure | least | most | false stops in 10 min | grazes apart | "
      "target "
      "| s |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n",
      family.name, family.promise, family.measure);
}

std::string row(const Cell& cell, Rule rule, unsigned runs, const Outcome& sum, double seconds) {
  const auto middle = median(sum.measures);
  const auto [least, most] = std::minmax_element(sum.measures.begin(), sum.measures.end());
  const auto number = [&](double value) { return middle ? fmt::format("{:.2f}", value) : std::string("-"); };
  const std::string miss = rule == Rule::kFencepost ? missed(cell.target, sum) : "";
  return fmt::format("| {} | {} | {} | {:.1f} | {} | {} | {} | {} | {:.2f} | {} | {}{} | {:.1f} |\n", cell.scene,
                     name(rule), runs, percent_kept(sum), sum.asked, number(middle.value_or(0)),
                     number(middle ? *least : 0), number(middle ? *most : 0),
                     in_ten_minutes(sum, sum.false_stops - sum.grazes), sum.grazes, text_of(cell.target),
                     miss.empty() ? "" : " **missed**", seconds);
}

std::string missed(const Target& target, const Outcome& sum) {
  std::string text;
  if (target.kept && !(sum.asked > 0 && percent_kept(sum) >= *target.kept)) {
    text += fmt::format("{:.1f} % of {} kept, {} asked for", percent_kept(sum), sum.asked, *target.kept);
  }
  const double false_stops = in_ten_minutes(sum, sum.false_stops - sum.grazes);
  if (target.false_stops && !(sum.seconds > 0 && false_stops <= *target.false_stops)) {
    text += fmt::format("{}{:.2f} false stops in 10 min, {} allowed", text.empty() ? "" : "; ", false_stops,
                        *target.false_stops);
  }
  return text;
}

double percent_kept(const Outcome& outcome) { return outcome.asked > 0 ? 100.0 * outcome.kept / outcome.asked : 0; }

double in_ten_minutes(const Outcome& outcome, unsigned count) {
  return outcome.seconds > 0 ? 600 * count / outcome.seconds : 0;
}

std::optional<double> median(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace fencepost::test
