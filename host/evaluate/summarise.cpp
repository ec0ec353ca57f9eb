#include <algorithm>
#include <cmath>

#include "host/evaluate/evaluate.hpp"

namespace fencepost::host {
namespace {

Mean mean_of(const std::vector<double>& values) {
  Mean result;
  result.n = values.size();
  if (values.empty()) return result;
  const auto n = static_cast<double>(values.size());
  for (const double value : values) result.mean += value / n;
  if (values.size() < 2) return result;
  double squares = 0;
  for (const double value : values) squares += (value - result.mean) * (value - result.mean);
  result.standard_error = std::sqrt(squares / (n - 1) / n);
  return result;
}

std::vector<std::string> all_models(std::span<const Evaluation> evaluations) {
  std::vector<std::string> names;
  for (const Evaluation& evaluation : evaluations) {
    for (const std::string& name : evaluation.models) {
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
  }
  return names;
}

bool is_at(const Cut& cut, std::optional<std::uint32_t> views) {
  return views ? !cut.end && cut.views == *views : cut.end;
}

template <class Visit>
void for_each_cut(std::span<const Evaluation> evaluations, std::optional<std::uint32_t> views, Visit visit) {
  for (const Evaluation& evaluation : evaluations) {
    for (const ObjectEvaluation& object : evaluation.objects) {
      for (const Cut& cut : object.cuts) {
        if (is_at(cut, views)) visit(object, cut);
      }
    }
  }
}

/// The model's score; that of an empty model for an object that was not found. Nothing for a model that the profile
/// lacks.
std::optional<Score> score_of(const ObjectEvaluation& object, const Cut& cut, const std::string& model) {
  if (!object.found) return kEmptyScore;
  for (const ModelScore& entry : cut.models) {
    if (entry.model == model) return entry.score;
  }
  return std::nullopt;
}

SummaryRow model_row(std::span<const Evaluation> evaluations, const std::string& model,
                     std::optional<std::uint32_t> views) {
  SummaryRow row{model, views, {}, {}, {}, 0};
  std::vector<double> recklessness;
  std::vector<double> paranoia;
  std::vector<double> iou;
  for_each_cut(evaluations, views, [&](const ObjectEvaluation& object, const Cut& cut) {
    const std::optional<Score> score = score_of(object, cut, model);
    if (!score) return;
    recklessness.push_back(score->recklessness);
    if (score->empty) {
      ++row.empty;
    } else {
      paranoia.push_back(score->paranoia);
    }
    iou.push_back(score->iou);
  });
  row.recklessness = mean_of(recklessness);
  row.paranoia = mean_of(paranoia);
  row.iou = mean_of(iou);
  return row;
}

PositionRow position_row(std::span<const Evaluation> evaluations, std::optional<std::uint32_t> views) {
  std::vector<double> errors;
  for_each_cut(evaluations, views, [&](const ObjectEvaluation&, const Cut& cut) {
    if (cut.position_error) errors.push_back(*cut.position_error);
  });
  return {views, mean_of(errors)};
}

void count(const Evaluation& evaluation, Summary& summary) {
  for (const ObjectEvaluation& object : evaluation.objects) {
    if (object.cuts.empty()) continue;
    ++summary.objects;
    if (object.missed) ++summary.missed;
    if (object.found && object.found->state != record::ObjectState::kTentative) ++summary.found;
  }
  summary.phantoms += evaluation.phantoms.size();
  if (!evaluation.swaps) summary.swaps.reset();
  if (summary.swaps) *summary.swaps += *evaluation.swaps;
}

}  // namespace

Summary summarise(std::span<const Evaluation> evaluations, const std::vector<std::uint32_t>& views) {
  Summary summary;
  summary.logs = evaluations.size();
  summary.swaps = 0;
  for (const Evaluation& evaluation : evaluations) count(evaluation, summary);

  std::vector<std::optional<std::uint32_t>> moments(views.begin(), views.end());
  moments.emplace_back(std::nullopt);
  for (const std::string& model : all_models(evaluations)) {
    for (const auto& moment : moments) summary.rows.push_back(model_row(evaluations, model, moment));
  }
  for (const auto& moment : moments) summary.position.push_back(position_row(evaluations, moment));
  return summary;
}

}  // namespace fencepost::host
