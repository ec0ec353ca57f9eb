#include "host/result/to_json.hpp"

#include <fmt/format.h>

#include "host/geometry/rings.hpp"
#include "host/result/geojson.hpp"
#include "host/result/lookup.hpp"
#include "host/result/text.hpp"

namespace fencepost::host {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kFormat = 1;
constexpr int kRecordDecimals = 4;  ///< as in the record stream
constexpr int kRatioDecimals = 4;

Json log_json(const LogCounts& log) {
  Json rejected = Json::object();
  for (std::size_t i = 0; i < log.rejected.size(); ++i) {
    rejected[std::string(record::name(static_cast<record::Reject>(i)))] = log.rejected[i].count;
  }
  const RefusedFrames& refused = log.refused;
  return {{"records", log.records},
          {"frames", log.frames},
          {"odometry", log.odometry},
          {"foreign", log.foreign},
          {"refused",
           {{"no_pose", refused.no_pose},
            {"odometry_gap", refused.odometry_gap},
            {"no_camera", refused.no_camera},
            {"queue", refused.queue}}},
          {"rejected", std::move(rejected)}};
}

Json pose_json(const std::optional<PoseResult>& pose) {
  if (!pose) return nullptr;
  return {{"t", rounded(pose->t, kRecordDecimals)},
          {"x", rounded(pose->x, kLengthDecimals)},
          {"y", rounded(pose->y, kLengthDecimals)},
          {"heading", rounded(pose->heading, kLengthDecimals)}};
}

// A longer path has every n-th point, and the last.
Json path_json(const std::vector<PoseResult>& path) {
  constexpr std::size_t kMax = 2'000;
  const std::size_t step = path.size() <= kMax ? 1 : (path.size() - 2) / (kMax - 1) + 1;
  Json json = Json::array();
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (i % step != 0 && i + 1 != path.size()) continue;
    const PoseResult& pose = path[i];
    json.push_back({rounded(pose.t, kRecordDecimals), rounded(pose.x, kRecordDecimals),
                    rounded(pose.y, kRecordDecimals), rounded(pose.heading, kRecordDecimals)});
  }
  return json;
}

Json camera_json(const std::optional<sensor::CameraIntrinsics>& camera) {
  if (!camera) return nullptr;
  const sensor::CameraMount& mount = camera->mount;
  const auto number = [](const auto& quantity) { return rounded(quantity.to_double(), kRecordDecimals); };
  Json json = {{"model", camera->model.view()}, {"width", camera->width},   {"height", camera->height},
               {"fx", number(camera->fx)},      {"fy", number(camera->fy)}, {"cx", number(camera->cx)},
               {"cy", number(camera->cy)},      {"k1", number(camera->k1)}};
  if (camera->lens != sensor::Lens::kPinhole) json["lens"] = sensor::name(camera->lens);
  json["mount"] = {{"x", number(mount.x)},
                   {"y", number(mount.y)},
                   {"z", number(mount.z)},
                   {"yaw", number(mount.yaw)},
                   {"pitch", mount.pitch ? number(*mount.pitch) : Json(nullptr)}};
  json["latency"] = number(camera->latency);
  return json;
}

std::string rgb_text(const sensor::Rgb& rgb) { return fmt::format("{:02x}{:02x}{:02x}", rgb.red, rgb.green, rgb.blue); }

Json signatures_json(const std::vector<record::Signature>& signatures) {
  Json json = Json::array();
  for (const record::Signature& signature : signatures) {
    json.push_back({{"id", signature.signature}, {"name", signature.name.view()}, {"rgb", rgb_text(signature.rgb)}});
    if (signature.width > 0) json.back()["size"] = signature.width / 1e3;
    if (signature.pad != 0) json.back()["pad"] = signature.pad;
  }
  return json;
}

Json model_json(const ModelResult& model) {
  Json json = Json::object();
  Json geometry = to_geojson(model.geometry);
  if (is_cylinder(model)) {
    // One rule for readers: a cylinder's numbers are present exactly when its geometry is.
    const bool known = model.circle.has_value() && !geometry.is_null();
    json["x"] = known ? rounded(model.circle->center.x, kLengthDecimals) : Json(nullptr);
    json["y"] = known ? rounded(model.circle->center.y, kLengthDecimals) : Json(nullptr);
    json["radius"] = known ? rounded(model.circle->radius, kLengthDecimals) : Json(nullptr);
  }
  json["area"] = geometry.is_null() ? Json(nullptr) : rounded(area(model.geometry), kLengthDecimals);
  json["geometry"] = std::move(geometry);
  if (!model.open.empty()) json["open"] = lines_to_geojson(model.open);
  return json;
}

Json next_json(const std::optional<NextViewResult>& next) {
  if (!next) return nullptr;
  return {{"bearing", rounded(next->bearing, kRecordDecimals)},
          {"width", rounded(next->width, kRecordDecimals)},
          {"x", rounded(next->x, kLengthDecimals)},
          {"y", rounded(next->y, kLengthDecimals)},
          {"gain", rounded(next->gain, kRatioDecimals)}};
}

Json pass_json(const PassResult& pass) {
  return {{"t", rounded(pass.t, kRecordDecimals)},
          {"id", pass.id},
          {"signature", pass.signature},
          {"side", side_word(pass)},
          {"distance", rounded(pass.distance, kRecordDecimals)},
          {"known",
           {{"t", rounded(pass.known_at, kRecordDecimals)},
            {"bearing", rounded(pass.bearing, kRecordDecimals)},
            {"distance", rounded(pass.known_distance, kRecordDecimals)}}}};
}

Json object_json(const ResultDocument& document, const ObjectResult& object) {
  const record::Signature* const signature = find_signature(document, object.signature);
  Json models = Json::object();
  for (const ModelResult& model : object.models) models[model.name] = model_json(model);
  return {{"id", object.id},
          {"signature", object.signature},
          {"name", signature != nullptr ? Json(signature->name.view()) : Json(nullptr)},
          {"rgb", signature != nullptr ? Json(rgb_text(signature->rgb)) : Json(nullptr)},
          {"state", record::name(object.state)},
          {"views", object.views},
          {"z_min", rounded(object.z_min, kLengthDecimals)},
          {"z_max", rounded(object.z_max, kLengthDecimals)},
          {"base", rounded(object.base, kLengthDecimals)},
          {"confidence", rounded(object.confidence, kRatioDecimals)},
          {"next", next_json(object.next)},
          {"models", std::move(models)}};
}

Json alert_json(const record::AlertReport& alert) {
  const bool blind = alert.level == record::AlertLevel::kBlind;
  const auto told = [blind](double value, int decimals) { return blind ? Json(nullptr) : rounded(value, decimals); };
  return {{"t", rounded(alert.t.to_double(), kRecordDecimals)},
          {"level", record::name(alert.level)},
          {"id", alert.id},
          {"bearing", told(alert.bearing.to_double(), kRecordDecimals)},
          {"distance", told(alert.distance.to_double(), kRecordDecimals)},
          {"ttc", alert.ttc ? rounded(alert.ttc->to_double(), kRecordDecimals) : Json(nullptr)},
          {"confidence", told(alert.confidence.to_double(), kRatioDecimals)}};
}

Json guard_json(const std::vector<GuardPoint>& points) {
  Json guard = Json::array();
  for (const GuardPoint& point : points) {
    guard.push_back({{"x", rounded(point.x, kLengthDecimals)},
                     {"y", rounded(point.y, kLengthDecimals)},
                     {"signature", point.signature}});
  }
  return guard;
}

Json sectors_json(const std::optional<record::SectorReport>& report) {
  if (!report) return nullptr;
  Json distances = Json::array();
  for (const record::SectorReport::Sector& sector : report->sectors) {
    distances.push_back(sector.distance ? rounded(sector.distance->to_double(), kRecordDecimals) : Json(nullptr));
  }
  return {{"t", rounded(report->t.to_double(), kRecordDecimals)}, {"distances", std::move(distances)}};
}

Json ways_json(const std::optional<record::WayReport>& report) {
  if (!report) return nullptr;
  Json ways = Json::array();
  for (const record::WayReport::Way& way : report->ways) {
    ways.push_back({{"motion", record::name(way.motion)},
                    {"curvature", rounded(way.curvature.to_double(), kRatioDecimals)},
                    {"free", rounded(way.free.to_double(), kRecordDecimals)},
                    {"speed", rounded(way.speed.to_double(), kRecordDecimals)},
                    {"end", record::name(way.end)}});
  }
  return {{"t", rounded(report->t.to_double(), kRecordDecimals)}, {"ways", std::move(ways)}};
}

Json speed_json(const std::optional<base::Metres>& speed) {
  return speed ? rounded(speed->to_double(), kRecordDecimals) : Json(nullptr);
}

Json doubt_json(const record::CalibrationDoubt& doubt) {
  return {{"t", rounded(doubt.t.to_double(), kRecordDecimals)},
          {"doubt", record::name(doubt.doubt)},
          {"factor", rounded(doubt.factor.to_double(), kRatioDecimals)},
          {"says", calibration_sentence(doubt)}};
}

// A profile name comes from the log and may hold any byte: replace what is not UTF-8 rather than throw.
std::string text_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

std::string without_last(std::string text) {
  text.pop_back();
  return text;
}

}  // namespace

void write_json(const ResultDocument& document, const EachAlert& alerts,
                const std::function<void(std::string_view)>& write) {
  Json objects = Json::array();
  for (const ObjectResult& object : document.objects) objects.push_back(object_json(document, object));
  Json calibration = Json::array();
  for (const record::CalibrationDoubt& doubt : document.calibration) calibration.push_back(doubt_json(doubt));
  Json passes = Json::array();
  for (const PassResult& pass : document.passes) passes.push_back(pass_json(pass));
  const Json before = {{"format", kFormat},
                       {"log", log_json(document.log)},
                       {"digest", digest_text(document.digest)},
                       {"profile", document.profile},
                       {"camera", camera_json(document.camera)},
                       {"signatures", signatures_json(document.signatures)},
                       {"pose", pose_json(document.pose)},
                       {"path", path_json(document.path)},
                       {"objects", std::move(objects)}};
  const Json after = {{"guard", guard_json(document.guard)},   {"sectors", sectors_json(document.sectors)},
                      {"ways", ways_json(document.ways)},      {"speed_limit", speed_json(document.speed_limit)},
                      {"calibration", std::move(calibration)}, {"passes", std::move(passes)}};
  // One object, with the alerts between its halves: there may be very many.
  write(without_last(text_of(before)));
  write(",\"alerts\":[");
  bool first = true;
  alerts([&](const record::AlertReport& alert) {
    write((first ? "" : ",") + text_of(alert_json(alert)));
    first = false;
  });
  write("]," + text_of(after).substr(1) + "\n");
}

std::string to_json(const ResultDocument& document) {
  std::string text;
  const EachAlert alerts = [&](const std::function<void(const record::AlertReport&)>& visit) {
    for (const record::AlertReport& alert : document.alerts) visit(alert);
  };
  write_json(document, alerts, [&](std::string_view part) { text += part; });
  return text;
}

}  // namespace fencepost::host
