#include <cmath>
#include <nlohmann/json.hpp>

#include "host/geometry/rings.hpp"
#include "host/scene/camera_numbers.hpp"
#include "host/scene/load.hpp"
#include "host/scene/noise_rows.hpp"
#include "host/scene/rgb.hpp"

namespace fencepost::host {

namespace {

using Json = nlohmann::ordered_json;

Json ring_json(const LinearRing& ring) {
  Json list = Json::array();
  for (const Point p : closed(ring)) list.push_back({p.x, p.y});
  return list;
}

Json footprint_json(const Polygon& footprint) {
  Point center;
  double radius = 0;
  if (footprint.holes.empty() && is_circle_ring(footprint.outer, center, radius)) {
    // To the nanometre: the centre of the vertices is not the written number to the last bit.
    const auto nanometres = [](double value) { return std::round(value * 1e9) / 1e9; };
    return {{"circle", {nanometres(center.x), nanometres(center.y), nanometres(radius)}}};
  }
  Json rings = Json::array({ring_json(footprint.outer)});
  for (const LinearRing& hole : footprint.holes) rings.push_back(ring_json(hole));
  return {{"type", "Polygon"}, {"coordinates", rings}};
}

Json robot_json(const RobotBody& body) {
  if (!body.footprint.empty()) return {{"footprint", ring_json(body.footprint)}};
  Json out = Json::object();
  if (body.front) out["front"] = *body.front;
  if (body.rear) out["rear"] = *body.rear;
  out["width"] = body.width.value_or(0.2);
  return out;
}

Json path_json(const ArcPath& arc) {
  return {{"type", "arc"},
          {"center", {arc.center.x, arc.center.y}},
          {"radius", arc.radius},
          {"start", arc.start},
          {"sweep", arc.sweep},
          {"views", arc.views},
          {"look_at", arc.look_outwards ? "outwards" : "center"}};
}

Json path_json(const WaypointPath& path) {
  Json points = Json::array();
  for (const Point p : path.points) points.push_back({p.x, p.y});
  Json out = {{"type", "waypoints"}, {"points", points}, {"speed", path.speed}};
  if (path.turn_radius > 0) {
    out["turn_radius"] = path.turn_radius;
  } else {
    out["turn_rate"] = path.turn_rate;
  }
  if (path.laps > 0) out["laps"] = path.laps;
  if (path.wait > 0) out["wait"] = path.wait;
  return out;
}

Json path_json(const PosesPath& path) {
  Json poses = Json::array();
  for (const TimedPose& p : path.poses) poses.push_back({{"t", p.t}, {"x", p.x}, {"y", p.y}, {"heading", p.heading}});
  return {{"type", "poses"}, {"poses", poses}};
}

Json odometry_json(const SceneOdometry& odometry) {
  const bool gyro = odometry.kind == SceneOdometry::Kind::kGyro;
  Json out = {{"kind", gyro ? "gyro" : "steering"}, {"counts", odometry.counts}};
  if (odometry.wheelbase > 0) out["wheelbase"] = odometry.wheelbase;
  return out;
}

Json path_json(std::monostate) { return {}; }

/// Only what differs from the defaults.
Json noise_json(const SceneNoise& noise) {
  const SceneNoise defaults;
  Json out = Json::object();
  for (const NoiseRow& row : kNoiseRows) {
    if (noise.*row.value != defaults.*row.value) out[std::string(row.key)] = noise.*row.value;
    if (row.value != &SceneNoise::edge_bias_px || noise.edge_bias_of.empty()) continue;
    Json& of = out["edge_bias_px"] = Json::object();
    for (const auto& [signature, px] : noise.edge_bias_of) of[std::to_string(signature)] = px;
  }
  return out;
}

Json object_json(const SceneObject& object) {
  Json out = {{"name", object.name}};
  if (object.trained) out["signature"] = object.signature;
  out["base"] = object.base;
  out["height"] = object.height_m;
  out["footprint"] = footprint_json(object.footprint);
  if (!object.path.empty()) out["path"] = path_json(PosesPath{object.path});
  if (object.from) out["from"] = *object.from;
  if (object.until) out["until"] = *object.until;
  if (!object.trained) out["trained"] = false;
  return out;
}

}  // namespace

Json camera_json(const sensor::CameraIntrinsics& camera) {
  Json mount = {{"x", camera.mount.x.to_double()},
                {"y", camera.mount.y.to_double()},
                {"z", camera.mount.z.to_double()},
                {"yaw", camera.mount.yaw.to_double()}};
  mount["pitch"] = camera.mount.pitch ? Json(camera.mount.pitch->to_double()) : Json(nullptr);
  Json written = {{"model", std::string(camera.model.view())},
                  {"width", camera.width},
                  {"height", camera.height},
                  {"fx", camera.fx.to_double()},
                  {"fy", camera.fy.to_double()},
                  {"cx", camera.cx.to_double()},
                  {"cy", camera.cy.to_double()},
                  {"k1", camera.k1.to_double()},
                  {"mount", mount},
                  {"latency", camera.latency.to_double()}};
  if (camera.lens != sensor::Lens::kPinhole) written["lens"] = std::string(name(camera.lens));
  return written;
}

Json signature_json(const SceneSignature& signature) {
  Json out = {{"id", signature.id}, {"name", signature.name}, {"rgb", rgb_text(signature.rgb)}};
  if (signature.width > 0) out["size"] = signature.width / 1e3;
  if (signature.pad != 0) out["pad"] = signature.pad;
  return out;
}

std::string write_scene(const Scene& scene) {
  Json root = {{"format", 1}, {"seed", scene.seed}, {"camera", camera_json(scene.camera)}};
  root["camera"]["rate"] = scene.rate;
  root["camera"]["max_blobs"] = scene.max_blobs;
  root["robot"] = robot_json(scene.robot);
  root["signatures"] = Json::array();
  for (const SceneSignature& signature : scene.signatures) root["signatures"].push_back(signature_json(signature));
  root["objects"] = Json::array();
  for (const SceneObject& object : scene.objects) root["objects"].push_back(object_json(object));
  const Json path = std::visit([](const auto& p) { return path_json(p); }, scene.path);
  if (!path.is_null()) root["path"] = path;
  if (scene.odometry.of_car()) root["odometry"] = odometry_json(scene.odometry);
  const Json noise = noise_json(scene.noise);
  if (!noise.empty()) root["noise"] = noise;
  return root.dump(2) + "\n";
}

}  // namespace fencepost::host
