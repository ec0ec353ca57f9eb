#include "host/web/thinned_run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "host/result/thinned.hpp"
#include "host/text/gzip.hpp"

namespace fencepost::host {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMaxPoses = 1U << 14U;
constexpr std::size_t kMaxAlerts = 1U << 13U;
constexpr std::size_t kMaxDoubts = 100;
constexpr std::size_t kLevels = 11;
constexpr std::size_t kPlain = 4;  ///< from that level on the end has no more models than the rest
constexpr std::uint64_t kMaxStopped = 1024;

double millimetres(double metres) { return std::round(metres * 1000) / 1000 + 0.0; }

void round_points(std::vector<Point>& points) {
  for (Point& point : points) point = {millimetres(point.x), millimetres(point.y)};
}

/// Keeps of an object's models those that the page shows by default.
void keep_plain_models(std::vector<ObjectResult>& objects) {
  for (ObjectResult& object : objects) {
    std::erase_if(object.models,
                  [](const ModelResult& model) { return model.name != "hybrid" && model.name != "cylinder"; });
    for (ModelResult& model : object.models) {
      for (Polygon& polygon : model.geometry) {
        round_points(polygon.outer);
        for (LinearRing& hole : polygon.holes) round_points(hole);
      }
      for (Polyline& open : model.open) round_points(open);
    }
  }
}

Json path_json(const std::vector<PoseResult>& path) {
  Json json = Json::array();
  for (const PoseResult& pose : path) {
    for (const double value : {pose.t, pose.x, pose.y, pose.heading}) json.push_back(millimetres(value));
  }
  return json;
}

std::string count_of(std::size_t kept, std::uint64_t all, const std::string& what) {
  return (kept < all ? std::to_string(kept) + " of " : "all ") + std::to_string(all) + " " + what;
}

}  // namespace

bool ThinnedRun::Looks::add(Look look) {
  bytes += look.json.size();
  kept.push_back(std::move(look));
  if (kept.size() <= kMaxLooks && bytes <= kMaxBytes) return false;
  std::vector<Look> half;
  for (std::size_t i = 0; i < kept.size(); i += 2) half.push_back(std::move(kept[i]));
  kept = std::move(half);
  bytes = 0;
  for (const Look& one : kept) bytes += one.json.size();
  return true;
}

void ThinnedRun::Looks::collect(std::size_t level, std::vector<const Look*>& some) const {
  for (std::size_t i = 0; i < kept.size(); i += std::size_t{1} << level) some.push_back(&kept[i]);
}

ThinnedRun::ThinnedRun(const ReplayOptions& options, AlertSink& alerts) : alerts_(alerts), replay_(heard(options)) {}

ReplayOptions ThinnedRun::heard(ReplayOptions options) {
  options.alerts = this;
  options.most_poses = kPosesToShow;
  return options;
}

void ThinnedRun::run_begins() {
  alerts_.run_begins();
  even_ = {};
  step_ = kFirstStep;
  stops_ = {};
  stop_count_ = 0;
  stop_stride_ = 1;
  stop_begins_ = false;
  stopped_.clear();
}

void ThinnedRun::hear(const record::AlertReport& alert) {
  alerts_.hear(alert);
  if (stopped_.size() > kMaxStopped) stopped_.clear();
  if (alert.level != record::AlertLevel::kStop) {
    stopped_.erase(alert.id);
  } else if (stopped_.insert(alert.id).second && stop_count_++ % stop_stride_ == 0) {
    stop_begins_ = true;
  }
}

void ThinnedRun::take(std::string_view bytes) {
  constexpr double kAnyTime = -std::numeric_limits<double>::infinity();
  while (!bytes.empty()) {
    bytes.remove_prefix(replay_.feed(bytes, kAnyTime));  // an input
    after_input();
  }
}

void ThinnedRun::after_input() {
  const LogReplay& log = replay_.log();
  if (log.path_count() == 0) return;
  if (stop_begins_) {
    stop_begins_ = false;
    if (stops_.add(look())) stop_stride_ *= 2;
  } else if (even_.kept.empty() || log.time() >= even_.kept.back().time + step_) {
    if (even_.add(look())) step_ *= 2;
  }
}

void ThinnedRun::finish() { replay_.finish(); }

ThinnedRun::Look ThinnedRun::look() const {
  ResultDocument document = replay_.log().now(false);
  document.alerts.clear();
  document.passes.clear();
  document.calibration.clear();
  keep_plain_models(document.objects);
  Json whole = Json::parse(to_json(document));
  Json result;
  for (const char* key : {"digest", "log", "pose", "objects", "guard"}) result[key] = std::move(whole[key]);
  const double time = replay_.log().time();
  const Json json = {{"time", time}, {"result", std::move(result)}, {"frame", Json::parse(replay_.page()).at("frame")}};
  return {time, json.dump()};
}

ThinnedText ThinnedRun::text(const EachAlert& alerts, std::size_t most) const {
  const std::vector<PoseResult> path = replay_.log().now().path;
  for (std::size_t level = 0;; ++level) {
    std::vector<const Look*> looks;
    even_.collect(level, looks);
    stops_.collect(level, looks);
    std::ranges::sort(looks, {}, &Look::time);
    const std::vector<PoseResult> shown = thin_path_to(path, kMaxPoses >> level);
    const ThinnedAlerts kept = thin_alerts(alerts, std::max<std::size_t>(kMaxAlerts >> level, 16));

    ResultDocument end = replay_.log().now(false);
    Json page = Json::parse(replay_.page());
    const std::size_t doubts = end.calibration.size();
    if (doubts > kMaxDoubts) {
      end.calibration.resize(kMaxDoubts);
      page["complaints"].push_back("only the first " + std::to_string(kMaxDoubts) + " of " + std::to_string(doubts) +
                                   " doubts about the calibration are shown here");
    }
    end.passes.clear();
    if (level >= kPlain) keep_plain_models(end.objects);

    ThinnedText text;
    text.said = count_of(shown.size(), replay_.log().path_count(), "poses") + ", " +
                count_of(kept.kept.size(), kept.all, "alerts") + ", map and camera at " + std::to_string(looks.size()) +
                " times and at the end";
    std::string json = Json{{"said", text.said}, {"alerts", kept.all}, {"stops", kept.stops}}.dump();
    json.back() = ',';
    json += "\"path\":" + path_json(shown).dump() +
            ",\"page\":" + page.dump(-1, ' ', false, Json::error_handler_t::replace);
    json += ",\"result\":";
    const auto each_kept = [&](const auto& visit) { std::ranges::for_each(kept.kept, visit); };
    write_json(end, each_kept, [&](std::string_view part) { json += part; });
    json += ",\"looks\":[";
    for (const Look* look : looks) json += (look == looks.front() ? std::string() : std::string(",")) + look->json;
    text.packed = gzip(json + "]}");
    if (text.packed.size() <= most || level + 1 == kLevels) return text;
  }
}

}  // namespace fencepost::host
