#include "host/evaluate/evaluation_part.hpp"

#include <iterator>
#include <utility>

#include "host/evaluate/log_json.hpp"

namespace fencepost::host {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kPartFormat = 2;

template <class Number>
std::optional<Number> read_known(const Json& json) {
  return json.is_null() ? std::nullopt : std::optional(json.get<Number>());
}

record::ObjectState read_state(const std::string& word) {
  for (const auto state :
       {record::ObjectState::kTentative, record::ObjectState::kConfirmed, record::ObjectState::kLost}) {
    if (record::name(state) == word) return state;
  }
  throw NotAPart("unknown state " + word);
}

Score read_score(const Json& json) {
  if (json.at("paranoia").is_null()) return kEmptyScore;
  return {json.at("recklessness"), json.at("paranoia"), json.at("iou"), false};
}

Cut read_cut(const Json& json) {
  Cut cut;
  cut.views = json.at("views");
  cut.end = json.at("end");
  cut.position_error = read_known<double>(json.at("position_error"));
  for (const auto& [model, score] : json.at("models").items()) {
    cut.models.push_back({model, read_score(score)});
  }
  return cut;
}

ObjectEvaluation read_object(const Json& json) {
  ObjectEvaluation object;
  object.truth = json.at("truth");
  object.name = json.at("name");
  object.signature = json.at("signature");
  object.visible = json.at("visible");
  object.missed = json.at("missed");
  if (const Json& found = json.at("found"); !found.is_null()) {
    object.found = {found.at("id"), read_state(found.at("state")), found.at("views")};
    object.swaps = read_known<std::uint64_t>(found.at("swaps"));
  }
  for (const Json& cut : json.at("cuts")) object.cuts.push_back(read_cut(cut));
  return object;
}

Evaluation read_log(const Json& json) {
  Evaluation evaluation;
  evaluation.log = json.at("log");
  evaluation.scene = json.at("scene");
  evaluation.frame_truth = json.at("frame_truth");
  evaluation.frames = json.at("frames");
  evaluation.digest = std::stoull(json.at("digest").get<std::string>(), nullptr, 16);
  evaluation.profile = json.at("profile");
  evaluation.models = json.at("models").get<std::vector<std::string>>();
  evaluation.swaps = read_known<std::uint64_t>(json.at("swaps"));
  for (const Json& object : json.at("objects")) evaluation.objects.push_back(read_object(object));
  for (const Json& phantom : json.at("phantoms")) {
    evaluation.phantoms.push_back({phantom.at("id"), phantom.at("signature"), phantom.at("views"),
                                   read_known<std::size_t>(phantom.at("follows"))});
    const auto& follows = evaluation.phantoms.back().follows;
    if (follows && *follows >= evaluation.objects.size()) throw NotAPart("a phantom follows no object");
  }
  return evaluation;
}

}  // namespace

std::string part_json(const EvaluationPart& part) {
  Json logs = Json::array();
  for (const Evaluation& evaluation : part.evaluations) logs.push_back(log_json(evaluation, Digits::kAll));
  const Json json = {{"format", kPartFormat},
                     {"part", true},
                     {"views", part.views},
                     {"logs", std::move(logs)},
                     {"unjudged", unjudged_json(part.unjudged)}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

EvaluationPart read_part(std::string_view text, const std::string& name) {
  try {
    const Json json = Json::parse(text);
    if (!json.value("part", false)) {
      throw NotAPart(name +
                     ": no part of an evaluation; write it by 'fencepost evaluate --part', which has all digits");
    }
    if (json.at("format") != kPartFormat)
      throw NotAPart(name + ": of another format; evaluate and merge by one version");
    EvaluationPart part;
    part.views = json.at("views").get<std::vector<std::uint32_t>>();
    for (const Json& log : json.at("logs")) part.evaluations.push_back(read_log(log));
    for (const Json& log : json.at("unjudged")) part.unjudged.push_back({log.at("log"), log.at("why")});
    return part;
  } catch (const Json::exception& error) {
    throw NotAPart(name + ": no part of an evaluation (" + error.what() + "); was it written to its end?");
  } catch (const std::logic_error& error) {  // of a number
    throw NotAPart(name + ": no part of an evaluation (" + error.what() + "); was it written to its end?");
  }
}

EvaluationPart join_parts(std::vector<EvaluationPart> parts) {
  EvaluationPart whole;
  if (!parts.empty()) whole.views = parts.front().views;
  for (EvaluationPart& part : parts) {
    if (part.views != whole.views) {
      throw NotAPart("the parts were measured at different numbers of views; give all the same --views");
    }
    std::move(part.evaluations.begin(), part.evaluations.end(), std::back_inserter(whole.evaluations));
    std::move(part.unjudged.begin(), part.unjudged.end(), std::back_inserter(whole.unjudged));
  }
  return whole;
}

}  // namespace fencepost::host
