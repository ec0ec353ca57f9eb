#include "host/web/page_replay.hpp"

#include <nlohmann/json.hpp>

#include "host/result/to_json.hpp"

namespace fencepost::host {
namespace {

using Json = nlohmann::ordered_json;

Json settings_json(const config::Settings* settings) {
  Json json = Json::object();
  if (settings == nullptr) return json;
  for (std::size_t i = 0; i < config::kKeys; ++i) {
    json[std::string(config::kKeyInfo[i].name)] = settings->text(static_cast<config::Key>(i)).view();
  }
  return json;
}

std::string written(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace

ReplayOptions PageReplay::of_profile(std::string_view profile) {
  ReplayOptions options;
  options.profile = std::string(profile);
  return options;
}

ReplayOptions PageReplay::observed(ReplayOptions options) {
  options.check = true;
  options.observer = this;
  return options;
}

std::size_t PageReplay::feed(std::string_view bytes, double until) {
  const std::uint32_t run = log_.runs();
  for (std::string_view left = bytes; !left.empty() && !log_.ended();) {
    const std::optional<record::LineOutcome> line = log_.take(left);
    if (!line) continue;
    note(line);
    if (log_.time() >= until || log_.runs() != run) return bytes.size() - left.size();
  }
  return bytes.size();
}

void PageReplay::finish() {
  note(log_.finish());
  finished_ = true;
}

void PageReplay::note(const std::optional<record::LineOutcome>& line) {
  if (!line || line->use != record::LineUse::kRejected || bad_lines_.size() == kBadLines) return;
  bad_lines_.push_back({line->line_number, line->reject});
}

void PageReplay::frame_placed(const PlacedFrame& placed) {
  Boxes boxes;
  boxes.frame = placed.frame;
  boxes.exposure = placed.frame.t.to_double() - (log_.camera() ? log_.camera()->latency.to_double() : 0);
  boxes.ids.assign(placed.frame.blobs.size(), record::kNoObject);
  for (const PlacedSighting& sighting : placed.sightings) {
    if (sighting.blob < boxes.ids.size()) boxes.ids[sighting.blob] = sighting.id;
  }
  boxes_ = std::move(boxes);
}

std::string PageReplay::result() const { return to_json(log_.now()); }

std::string PageReplay::state(bool with_alerts) const {
  ResultDocument document = log_.now(false);
  if (!with_alerts) document.alerts.clear();
  return to_json(document);
}

std::string PageReplay::page() const {
  Json frame = nullptr;
  if (boxes_) {
    Json boxes = Json::array();
    for (std::size_t i = 0; i < boxes_->ids.size(); ++i) {
      const recon::WaitingBlob& blob = boxes_->frame.blobs[i];
      boxes.push_back({{"id", boxes_->ids[i]},
                       {"signature", blob.signature},
                       {"box", {blob.box.x1, blob.box.y1, blob.box.x2, blob.box.y2}}});
    }
    frame = {{"t", boxes_->frame.t.to_double()},
             {"number", boxes_->frame.frame},
             {"exposure", boxes_->exposure},
             {"boxes", std::move(boxes)}};
  }
  Json bad = Json::array();
  for (const BadLine& line : bad_lines_) {
    bad.push_back({{"line", line.number}, {"reason", record::name(line.reason)}});
  }
  Json unreadable = nullptr;
  if (finished_) {
    if (const std::optional<Unreadable> why = log_.why_unreadable("log")) unreadable = why->message;
  }
  const CheckOutcome& check = log_.check();
  return written({{"time", log_.time()},
                  {"runs", log_.runs()},
                  {"frame", std::move(frame)},
                  {"settings", settings_json(log_.settings())},
                  {"bad_lines", std::move(bad)},
                  {"complaints", log_.complaints()},
                  {"unreadable", std::move(unreadable)},
                  {"check",
                   {{"compared", check.compared},
                    {"differing", check.differing},
                    {"damaged", check.damaged},
                    {"first", check.mismatches}}}});
}

}  // namespace fencepost::host
