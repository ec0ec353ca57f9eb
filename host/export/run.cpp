#include "host/export/run.hpp"

#include <utility>

#include "host/result/lookup.hpp"

namespace fencepost::host::exports {

void RunInputs::take(std::string_view bytes) {
  while (!bytes.empty()) reader_.take(bytes, *this);
}

void RunInputs::accept(const record::Header& /*header*/) {
  frames_.clear();
  settings_ = {};
}

void RunInputs::accept(const sensor::BlobFrame& frame) {
  const double t = frame.t.to_double();
  if (options_.from && t < *options_.from) return;
  if (options_.to && t > *options_.to) return;
  if (options_.frames && taken_ >= *options_.frames) return;
  ++taken_;
  if (with_frames_) frames_.push_back(frame);
}

void RunInputs::accept(const record::Setting& setting) {
  static_cast<void>(settings_.set(setting.key.view(), setting.value.view()));
}

namespace {

/// Drops the data that would fill memory in a long run.
void leave_out_unused(ObjectResult& object, bool outlines) {
  const ModelResult* shown = outlines ? outline_of(object, "") : nullptr;
  for (ModelResult& model : object.models) {
    if (&model == shown) continue;
    model.geometry = {};
    model.open = {};
  }
  object.models.shrink_to_fit();
}

}  // namespace

void History::run_begins() {
  last_.clear();
  objects_.clear();
}

void History::frame_placed(const PlacedFrame& placed) {
  const double t = placed.frame.t.to_double();
  for (const PlacedSighting& sighting : placed.sightings) {
    const auto [last, first_time] = last_.try_emplace(sighting.id, t);
    if (!first_time && t - last->second < interval_) continue;
    last->second = t;
    objects_.push_back({t, placed.outline(sighting.id)});
    leave_out_unused(objects_.back().object, outlines_);
  }
}

Run make_run(std::string_view log, const std::string& name, RunInputs& inputs, ReplayOutcome replayed,
             History& history) {
  Run run;
  run.document = std::move(replayed.result);
  run.history = history.take();
  run.frames = std::move(inputs.frames());
  run.settings = inputs.settings();
  run.name = name;
  run.log = log;
  return run;
}

const ModelResult* outline_of(const ObjectResult& object, const std::string& model) {
  if (!model.empty()) {
    const ModelResult* asked = find_model(object, model);
    return asked != nullptr && !asked->geometry.empty() ? asked : nullptr;
  }
  for (const char* name : {"hybrid", "cylinder"}) {
    const ModelResult* found = find_model(object, name);
    if (found != nullptr && !found->geometry.empty()) return found;
  }
  return nullptr;
}

bool is_solid(const ObjectResult& object) { return object.state != record::ObjectState::kTentative; }

std::string title_of(const ResultDocument& document, const ObjectResult& object) {
  return std::to_string(object.id) + " " + signature_name(document, object.signature);
}

}  // namespace fencepost::host::exports
