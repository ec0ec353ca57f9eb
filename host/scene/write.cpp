#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "host/geometry/rings.hpp"
#include "host/scene/load.hpp"

namespace fencepost::host {

namespace {

using Json = nlohmann::ordered_json;

Json camera_json(const Scene& scene) {
  const sensor::CameraIntrinsics& camera = scene.camera;
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
                  {"latency", camera.latency.to_double()},
                  {"rate", scene.rate},
                  {"max_blobs", scene.max_blobs}};
  if (camera.lens != sensor::Lens::kPinhole) written["lens"] = std::string(name(camera.lens));
  return written;
}

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
  const auto put = [&](const char* key, double SceneNoise::*member) {
    if (noise.*member != defaults.*member) out[key] = noise.*member;
  };
  put("edge_px", &SceneNoise::edge_px);
  put("edge_bias_px", &SceneNoise::edge_bias_px);
  if (!noise.edge_bias_of.empty()) out["edge_bias_px"] = Json::object();
  for (const auto& [signature, px] : noise.edge_bias_of) out["edge_bias_px"][std::to_string(signature)] = px;
  put("loss_probability", &SceneNoise::loss_probability);
  put("loss_min", &SceneNoise::loss_min);
  put("loss_max", &SceneNoise::loss_max);
  put("split_share", &SceneNoise::split_share);
  put("growth_probability", &SceneNoise::growth_probability);
  put("growth_max", &SceneNoise::growth_max);
  put("miss_probability", &SceneNoise::miss_probability);
  put("false_rate", &SceneNoise::false_rate);
  put("signature_swap_probability", &SceneNoise::signature_swap_probability);
  put("pose_xy", &SceneNoise::pose_xy);
  put("pose_heading", &SceneNoise::pose_heading);
  put("drift_scale", &SceneNoise::drift_scale);
  put("drift_turn", &SceneNoise::drift_turn);
  put("drift_walk", &SceneNoise::drift_walk);
  put("gyro_bias", &SceneNoise::gyro_bias);
  put("gyro_walk", &SceneNoise::gyro_walk);
  put("gyro_noise", &SceneNoise::gyro_noise);
  put("gyro_scale", &SceneNoise::gyro_scale);
  put("steer_offset", &SceneNoise::steer_offset);
  put("steer_scale", &SceneNoise::steer_scale);
  put("steer_backlash", &SceneNoise::steer_backlash);
  put("yaw_error", &SceneNoise::yaw_error);
  put("pitch_error", &SceneNoise::pitch_error);
  put("latency_jitter", &SceneNoise::latency_jitter);
  put("frame_drop_probability", &SceneNoise::frame_drop_probability);
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

std::string hex(sensor::Rgb rgb) {
  char digits[7];
  std::snprintf(digits, sizeof digits, "%02x%02x%02x", rgb.red, rgb.green, rgb.blue);
  return digits;
}

}  // namespace

std::string write_scene(const Scene& scene) {
  Json root = {{"format", 1}, {"seed", scene.seed}, {"camera", camera_json(scene)}};
  root["robot"] = robot_json(scene.robot);
  root["signatures"] = Json::array();
  for (const SceneSignature& s : scene.signatures) {
    root["signatures"].push_back({{"id", s.id}, {"name", s.name}, {"rgb", hex(s.rgb)}});
    if (s.width > 0) root["signatures"].back()["size"] = s.width / 1e3;
    if (s.pad != 0) root["signatures"].back()["pad"] = s.pad;
  }
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
