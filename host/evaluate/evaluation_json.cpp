#include "host/evaluate/evaluation_json.hpp"

#include "host/evaluate/log_json.hpp"
#include "host/result/geojson.hpp"

namespace fencepost::host {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kFormat = 2;

Json length(const std::optional<double>& metres) { return metres ? rounded(*metres, kDecimals) : Json(nullptr); }

Json mean_json(const Mean& mean) {
  return {{"mean", mean.n > 0 ? rounded(mean.mean, kDecimals) : Json(nullptr)},
          {"standard_error", length(mean.standard_error)},
          {"n", mean.n}};
}

Json summary_json(const Summary& summary) {
  Json models = Json::array();
  for (const SummaryRow& row : summary.rows) {
    models.push_back({{"model", row.model},
                      {"views", known(row.views)},
                      {"recklessness", mean_json(row.recklessness)},
                      {"paranoia", mean_json(row.paranoia)},
                      {"iou", mean_json(row.iou)},
                      {"empty", row.empty}});
  }
  Json position = Json::array();
  for (const PositionRow& row : summary.position) {
    position.push_back({{"views", known(row.views)}, {"error", mean_json(row.error)}});
  }
  return {{"logs", summary.logs},        {"objects", summary.objects},     {"found", summary.found},
          {"missed", summary.missed},    {"phantoms", summary.phantoms},   {"swaps", known(summary.swaps)},
          {"models", std::move(models)}, {"position", std::move(position)}};
}

}  // namespace

std::string to_json(std::span<const Evaluation> evaluations, const Summary& summary,
                    const std::vector<std::uint32_t>& views, std::span<const UnjudgedLog> unjudged) {
  Json logs = Json::array();
  for (const Evaluation& evaluation : evaluations) logs.push_back(log_json(evaluation, Digits::kShown));
  Json json = {{"format", kFormat}, {"views", views}, {"summary", summary_json(summary)}, {"logs", std::move(logs)}};
  if (!unjudged.empty()) json["unjudged"] = unjudged_json(unjudged);
  // Names come from files and may hold any byte: replace what is not UTF-8 rather than throw.
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace fencepost::host
