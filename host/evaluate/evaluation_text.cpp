#include "host/evaluate/evaluation_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/text/plural.hpp"
#include "host/text/printable.hpp"

namespace fencepost::host {
namespace {

constexpr std::size_t kColumns = 6;  ///< cells of a row; more do not fit into 80 columns

std::string swaps_text(const std::optional<std::uint64_t>& swaps) {
  return swaps ? plural(*swaps, "identity swap") : "identity swaps not known";
}

std::string score_cell(const Score& score) {
  if (score.empty) return "empty";
  return fmt::format("{:.0f}/{:.0f}/{:.0f}", 100 * score.recklessness, 100 * score.paranoia, 100 * score.iou);
}

const Cut* cut_at(const ObjectEvaluation& object, std::optional<std::uint32_t> views) {
  for (const Cut& cut : object.cuts) {
    if (views ? !cut.end && cut.views == *views : cut.end) return &cut;
  }
  return nullptr;
}

std::string model_cell(const Cut* cut, const std::string& model) {
  if (cut == nullptr) return "-";
  for (const ModelScore& entry : cut->models) {
    if (entry.model == model) return score_cell(entry.score);
  }
  return "-";
}

std::string position_cell(const Cut* cut) {
  return cut != nullptr && cut->position_error ? fmt::format("{:.1f}", 100 * *cut->position_error) : "-";
}

using Moments = std::vector<std::optional<std::uint32_t>>;

Moments all_moments(const std::vector<std::uint32_t>& views) {
  Moments moments(views.begin(), views.end());
  moments.emplace_back(std::nullopt);
  return moments;
}

std::string moment_name(std::optional<std::uint32_t> views) { return views ? std::to_string(*views) : "end"; }

std::string object_heading(const ObjectEvaluation& object) {
  std::string line = fmt::format("{}: ", printable(object.name));
  if (object.found) {
    line += fmt::format("object {}, {}, {} of {}", object.found->id, record::name(object.found->state),
                        object.found->views, plural(object.visible, "frame"));
    if (object.swaps.value_or(0) > 0) line += ", " + plural(*object.swaps, "identity swap");
    if (object.missed) line += ", missed";
  } else {
    line += fmt::format("{}, visible in {}", object.missed ? "missed" : "not found", plural(object.visible, "frame"));
  }
  return line + "\n";
}

std::string object_table(const ObjectEvaluation& object, const std::vector<std::string>& models,
                         std::span<const std::optional<std::uint32_t>> moments) {
  std::string text = fmt::format("  {:<15}", "views");
  for (const auto& moment : moments) text += fmt::format(" {:>9}", moment_name(moment));
  text += "\n";
  for (const std::string& model : models) {
    text += fmt::format("  {:<15}", printable(model));
    for (const auto& moment : moments) text += fmt::format(" {:>9}", model_cell(cut_at(object, moment), model));
    text += "\n";
  }
  text += fmt::format("  {:<15}", "position, cm");
  for (const auto& moment : moments) text += fmt::format(" {:>9}", position_cell(cut_at(object, moment)));
  return text + "\n";
}

std::string phantom_line(const Phantom& phantom, const Evaluation& evaluation) {
  std::string line =
      fmt::format("phantom: object {}, signature {}, {}", phantom.id, phantom.signature, plural(phantom.views, "view"));
  if (phantom.follows) line += ", a double of " + printable(evaluation.objects[*phantom.follows].name);
  return line + "\n";
}

std::string one_log(const Evaluation& evaluation, const std::vector<std::uint32_t>& views) {
  const Moments moments = all_moments(views);
  std::string text =
      "R/P/IoU in %: share of the footprint missed, share of the model that is free,\n"
      "overlap. 0/0/100 is perfect. Columns: views of the object.\n";
  for (const ObjectEvaluation& object : evaluation.objects) {
    text += "\n" + object_heading(object);
    if (!object.found) continue;
    for (std::size_t i = 0; i < moments.size(); i += kColumns) {
      text += object_table(object, evaluation.models,
                           std::span(moments).subspan(i, std::min(kColumns, moments.size() - i)));
    }
  }
  if (!evaluation.phantoms.empty()) text += "\n";
  for (const Phantom& phantom : evaluation.phantoms) text += phantom_line(phantom, evaluation);
  return text;
}

std::string mean_cell(const Mean& mean, double scale) {
  if (mean.n == 0) return "-";
  if (!mean.standard_error) return fmt::format("{:.1f}", scale * mean.mean);
  return fmt::format("{:.1f} +- {:>4.1f}", scale * mean.mean, scale * *mean.standard_error);
}

std::string mean_table(const Summary& summary) {
  std::string text = fmt::format("{:<15} {:>5} {:>14} {:>14} {:>14} {:>7} {:>5}\n", "model", "views", "recklessness %",
                                 "paranoia %", "IoU %", "objects", "empty");
  for (const SummaryRow& row : summary.rows) {
    text += fmt::format("{:<15} {:>5} {:>14} {:>14} {:>14} {:>7} {:>5}\n", printable(row.model), moment_name(row.views),
                        mean_cell(row.recklessness, 100), mean_cell(row.paranoia, 100), mean_cell(row.iou, 100),
                        row.recklessness.n, row.empty);
  }
  text += fmt::format("\n{:<15} {:>5} {:>14} {:>37}\n", "position error", "views", "cm", "objects");
  for (const PositionRow& row : summary.position) {
    text +=
        fmt::format("{:<15} {:>5} {:>14} {:>37}\n", "", moment_name(row.views), mean_cell(row.error, 100), row.error.n);
  }
  return text;
}

std::string several_logs(std::span<const Evaluation> evaluations, const Summary& summary) {
  std::string text = "Mean +- standard error over the objects of " + plural(evaluations.size(), "log") +
                     ".\nParanoia is of models that are not empty.\n\n";
  text += mean_table(summary) + "\n";
  for (const Evaluation& evaluation : evaluations) {
    for (const ObjectEvaluation& object : evaluation.objects) {
      if (object.missed) text += fmt::format("{}: missed {}\n", printable(evaluation.log), printable(object.name));
    }
    for (const Phantom& phantom : evaluation.phantoms) {
      text += fmt::format("{}: {}", printable(evaluation.log), phantom_line(phantom, evaluation));
    }
    if (evaluation.swaps.value_or(0) > 0) {
      text += fmt::format("{}: {}\n", printable(evaluation.log), swaps_text(evaluation.swaps));
    }
  }
  return text;
}

}  // namespace

std::string evaluation_text(std::span<const Evaluation> evaluations, const Summary& summary,
                            const std::vector<std::uint32_t>& views, std::span<const UnjudgedLog> unjudged) {
  const bool one = evaluations.size() == 1 && unjudged.empty();
  std::string text = one ? one_log(evaluations.front(), views) : several_logs(evaluations, summary);
  text += fmt::format("\n{}: {} found, {} missed; {}; {}\n", plural(summary.objects, "true object"), summary.found,
                      summary.missed, plural(summary.phantoms, "phantom"), swaps_text(summary.swaps));
  for (const UnjudgedLog& log : unjudged) text += fmt::format("not judged: {}\n", printable(log.log));
  return text;
}

}  // namespace fencepost::host
