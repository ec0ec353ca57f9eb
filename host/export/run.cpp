#include "host/export/run.hpp"

#include <array>
#include <utility>

#include "firmware/record/stream_reader.hpp"
#include "host/result/lookup.hpp"

namespace fencepost::host::exports {
namespace {

/// The inputs of the last run; the reader's sink.
class Inputs {
 public:
  Inputs(Run& run, const ReplayOptions& options) : run_(run), options_(options) {}

  void accept(const record::Header& /*header*/) {
    run_.frames.clear();
    run_.settings = {};
  }
  void accept(const sensor::BlobFrame& frame) {
    const double t = frame.t.to_double();
    if (options_.from && t < *options_.from) return;
    if (options_.to && t > *options_.to) return;
    if (options_.frames && taken_ >= *options_.frames) return;
    ++taken_;
    run_.frames.push_back(frame);
  }
  void accept(const record::Setting& setting) {
    static_cast<void>(run_.settings.set(setting.key.view(), setting.value.view()));
  }
  template <class Record>
  void accept(const Record& /*record*/) {}

 private:
  Run& run_;
  const ReplayOptions& options_;
  std::uint64_t taken_ = 0;
};

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
  }
}

Run make_run(std::string_view log, const std::string& name, const ReplayOptions& options, ReplayOutcome replayed,
             History& history) {
  Run run;
  run.document = std::move(replayed.result);
  run.history = history.take();
  run.name = name;
  run.log = log;
  Inputs inputs(run, options);
  std::array<char, record::StreamReader::kBuffer> buffer{};
  record::StreamReader reader(buffer);
  reader.push(log, inputs);
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
