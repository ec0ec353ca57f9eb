#include "host/smooth/truth_par.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/evaluate/matching.hpp"
#include "host/evaluate/metrics.hpp"
#include "host/result/geojson.hpp"
#include "host/text/printable.hpp"

namespace fencepost::host {
namespace {

using Json = nlohmann::ordered_json;

std::vector<ObjectResult> confirmed(const ResultDocument& map) {
  std::vector<ObjectResult> objects;
  for (const ObjectResult& object : map.objects) {
    if (object.state != record::ObjectState::kTentative && place_of(object)) objects.push_back(object);
  }
  return objects;
}

std::optional<std::size_t> seen_most(const std::vector<ObjectResult>& objects, std::uint8_t signature) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (objects[i].signature == signature && (!best || objects[i].views > objects[*best].views)) best = i;
  }
  return best;
}

std::string row(const char* name, const TruthPar& par) {
  return fmt::format("  {:<8} {:>8} {:>6} {:>10.3f} {:>10.3f} {:>10.3f}\n", name, par.objects, par.pairs,
                     par.as_it_stands, par.aligned, par.worst);
}

Json json_of(const TruthPar& par) {
  return {{"objects", par.objects},
          {"pairs", par.pairs},
          {"as_it_stands", rounded(par.as_it_stands, kLengthDecimals)},
          {"aligned", rounded(par.aligned, kLengthDecimals)},
          {"worst", rounded(par.worst, kLengthDecimals)}};
}

}  // namespace

TruthPar truth_par(const ResultDocument& map, const Scene& truth) {
  const std::vector<ObjectResult> objects = confirmed(map);
  const auto matches = match_objects(objects, truth);
  std::vector<PointPair> pairs;
  for (std::size_t i = 0; i < truth.objects.size(); ++i) {
    const SceneObject& object = truth.objects[i];
    std::optional<std::size_t> found;
    if (std::ranges::count(truth.objects, object.signature, &SceneObject::signature) == 1) {
      found = seen_most(objects, object.signature);
    } else if (const auto match = std::ranges::find(matches, std::optional(i)); match != matches.end()) {
      found = static_cast<std::size_t>(match - matches.begin());
    }
    if (found) pairs.push_back({*place_of(objects[*found]), centroid(object.footprint)});
  }
  TruthPar par;
  par.objects = objects.size();
  par.pairs = pairs.size();
  par.as_it_stands = rms_of(distances_after({}, pairs));
  const std::vector<double> distances = distances_after(aligned(pairs), pairs);
  par.aligned = rms_of(distances);
  par.worst = distances.empty() ? 0 : *std::ranges::max_element(distances);
  return par;
}

SmoothEvaluation evaluate_smoothed(const Smoothed& smoothed, const Scene& truth, const std::string& log_name) {
  return {log_name, truth_par(smoothed.online, truth), truth_par(smoothed.optimum, truth)};
}

std::string smooth_evaluation_text(const std::vector<SmoothEvaluation>& evaluations) {
  std::string text =
      "\nOnline against optimum (places of objects, m; aligned: after the turn and shift that suit each best)\n";
  for (const SmoothEvaluation& one : evaluations) {
    text += fmt::format("{}\n  {:<8} {:>8} {:>6} {:>10} {:>10} {:>10}\n", printable(one.log), "", "objects", "true",
                        "as it is", "aligned", "worst");
    text += row("online", one.online) + row("optimum", one.optimum);
  }
  return text;
}

std::string with_smooth_json(const std::string& evaluation, const std::vector<SmoothEvaluation>& evaluations) {
  Json json = Json::parse(evaluation);
  Json entries = Json::array();
  for (const SmoothEvaluation& one : evaluations) {
    entries.push_back({{"log", one.log}, {"online", json_of(one.online)}, {"optimum", json_of(one.optimum)}});
  }
  json["smooth"] = std::move(entries);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace fencepost::host
