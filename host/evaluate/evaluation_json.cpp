#include "host/evaluate/evaluation_json.hpp"

#include "host/result/geojson.hpp"
#include "host/result/lookup.hpp"

namespace fencepost::host {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kFormat = 1;
constexpr int kDecimals = 6;

template <class Number>
Json known(const std::optional<Number>& number) {
  return number ? Json(*number) : Json(nullptr);
}
Json length(const std::optional<double>& metres) { return metres ? rounded(*metres, kDecimals) : Json(nullptr); }

Json cut_json(const Cut& cut) {
  Json models = Json::object();
  for (const ModelScore& entry : cut.models) {
    models[entry.model] = {{"recklessness", rounded(entry.score.recklessness, kDecimals)},
                           {"paranoia", rounded(entry.score.paranoia, kDecimals)},
                           {"iou", rounded(entry.score.iou, kDecimals)}};
  }
  return {{"views", cut.views}, {"end", cut.end}, {"position_error", length(cut.position_error)}, {"models", models}};
}

Json found_json(const FoundObject& found, const std::optional<std::uint64_t>& swaps) {
  return {{"id", found.id}, {"state", record::name(found.state)}, {"views", found.views}, {"swaps", known(swaps)}};
}

Json object_json(const ObjectEvaluation& object) {
  Json cuts = Json::array();
  for (const Cut& cut : object.cuts) cuts.push_back(cut_json(cut));
  return {{"truth", object.truth},
          {"name", object.name},
          {"signature", object.signature},
          {"visible", object.visible},
          {"missed", object.missed},
          {"found", object.found ? found_json(*object.found, object.swaps) : Json(nullptr)},
          {"cuts", std::move(cuts)}};
}

Json log_json(const Evaluation& evaluation) {
  Json objects = Json::array();
  for (const ObjectEvaluation& object : evaluation.objects) objects.push_back(object_json(object));
  Json phantoms = Json::array();
  for (const Phantom& phantom : evaluation.phantoms) {
    phantoms.push_back({{"id", phantom.id},
                        {"signature", phantom.signature},
                        {"views", phantom.views},
                        {"follows", known(phantom.follows)}});
  }
  return {{"log", evaluation.log},
          {"scene", evaluation.scene},
          {"frame_truth", evaluation.frame_truth},
          {"frames", evaluation.frames},
          {"digest", digest_text(evaluation.digest)},
          {"profile", evaluation.profile},
          {"swaps", known(evaluation.swaps)},
          {"objects", std::move(objects)},
          {"phantoms", std::move(phantoms)}};
}

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
                      {"iou", mean_json(row.iou)}});
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
                    const std::vector<std::uint32_t>& views) {
  Json logs = Json::array();
  for (const Evaluation& evaluation : evaluations) logs.push_back(log_json(evaluation));
  const Json json = {
      {"format", kFormat}, {"views", views}, {"summary", summary_json(summary)}, {"logs", std::move(logs)}};
  // Names come from files and may hold any byte: replace what is not UTF-8 rather than throw.
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace fencepost::host
