#include "host/evaluate/log_json.hpp"

#include "host/result/geojson.hpp"
#include "host/result/lookup.hpp"

namespace fencepost::host {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value, Digits digits) { return digits == Digits::kAll ? Json(value) : rounded(value, kDecimals); }
Json length(const std::optional<double>& metres, Digits digits) {
  return metres ? number(*metres, digits) : Json(nullptr);
}

Json cut_json(const Cut& cut, Digits digits) {
  Json models = Json::object();
  for (const ModelScore& entry : cut.models) {
    models[entry.model] = {{"recklessness", number(entry.score.recklessness, digits)},
                           {"paranoia", entry.score.empty ? Json(nullptr) : number(entry.score.paranoia, digits)},
                           {"iou", number(entry.score.iou, digits)}};
  }
  return {{"views", cut.views},
          {"end", cut.end},
          {"position_error", length(cut.position_error, digits)},
          {"models", models}};
}

Json found_json(const FoundObject& found, const std::optional<std::uint64_t>& swaps) {
  return {{"id", found.id}, {"state", record::name(found.state)}, {"views", found.views}, {"swaps", known(swaps)}};
}

Json object_json(const ObjectEvaluation& object, Digits digits) {
  Json cuts = Json::array();
  for (const Cut& cut : object.cuts) cuts.push_back(cut_json(cut, digits));
  return {{"truth", object.truth},
          {"name", object.name},
          {"signature", object.signature},
          {"visible", object.visible},
          {"missed", object.missed},
          {"found", object.found ? found_json(*object.found, object.swaps) : Json(nullptr)},
          {"cuts", std::move(cuts)}};
}

}  // namespace

Json log_json(const Evaluation& evaluation, Digits digits) {
  Json objects = Json::array();
  for (const ObjectEvaluation& object : evaluation.objects) objects.push_back(object_json(object, digits));
  Json phantoms = Json::array();
  for (const Phantom& phantom : evaluation.phantoms) {
    phantoms.push_back({{"id", phantom.id},
                        {"signature", phantom.signature},
                        {"views", phantom.views},
                        {"follows", known(phantom.follows)}});
  }
  Json json = {{"log", evaluation.log},
               {"scene", evaluation.scene},
               {"frame_truth", evaluation.frame_truth},
               {"frames", evaluation.frames},
               {"digest", digest_text(evaluation.digest)},
               {"profile", evaluation.profile},
               {"swaps", known(evaluation.swaps)},
               {"objects", std::move(objects)},
               {"phantoms", std::move(phantoms)}};
  if (digits == Digits::kAll) json["models"] = evaluation.models;
  return json;
}

Json unjudged_json(std::span<const UnjudgedLog> logs) {
  Json json = Json::array();
  for (const UnjudgedLog& log : logs) json.push_back({{"log", log.log}, {"why", log.why}});
  return json;
}

}  // namespace fencepost::host
