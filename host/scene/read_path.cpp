#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>

#include "host/scene/noise_rows.hpp"
#include "host/scene/read_scene.hpp"
#include "host/scene/rounded_path.hpp"
#include "host/text/suggest.hpp"

namespace fencepost::host {

namespace {

/// A run of more frames than this is taken for a typing error.
constexpr double kMaxFrames = 1e6;

ArcPath read_arc(const JsonNode& node) {
  node.expect_keys({"type", "center", "radius", "start", "sweep", "views", "look_at"});
  ArcPath arc;
  arc.center = node.at("center").point();
  arc.radius = node.at("radius").number(0, kWorldLimit, "m");
  arc.start = node.number_or("start", 0, -100, 100, "rad");
  arc.sweep = node.at("sweep").number(-100, 100, "rad");
  arc.views = static_cast<int>(node.at("views").integer(1, static_cast<std::int64_t>(kMaxFrames)));
  if (const auto look_at = node.find("look_at")) {
    const std::string word = look_at->text();
    if (word != "center" && word != "outwards") {
      look_at->fail("unknown direction \"" + word + "\"", "write \"center\" or \"outwards\"");
    }
    arc.look_outwards = word == "outwards";
  }
  return arc;
}

void read_turn_radius(const JsonNode& node, const JsonNode& radius, WaypointPath& path) {
  path.turn_radius = radius.positive(kWorldLimit, "m");
  if (node.find("turn_rate"))
    radius.fail("is there beside turn_rate", "a car needs the radius only: leave turn_rate out");
  const std::optional<std::size_t> narrow = corner_without_room(path);
  if (!narrow) return;
  node.at("points").at(*narrow).fail("its arc has no room between the points beside it",
                                     "move them farther apart, or make turn_radius smaller");
}

WaypointPath read_waypoints(const JsonNode& node) {
  node.expect_keys({"type", "points", "speed", "turn_rate", "turn_radius", "laps", "wait"});
  WaypointPath path;
  const JsonNode points = node.at("points");
  const std::size_t count = points.size(2, "points");
  for (std::size_t i = 0; i < count; ++i) {
    path.points.push_back(points.at(i).point());
    if (i > 0 && path.points[i] == path.points[i - 1]) {
      points.at(i).fail("is the point before it again", "remove one of the two");
    }
  }
  if (const auto speed = node.find("speed")) path.speed = speed->positive(100, "m/s");
  if (const auto turn_rate = node.find("turn_rate")) path.turn_rate = turn_rate->positive(100, "rad/s");
  if (const auto laps = node.find("laps")) path.laps = static_cast<int>(laps->integer(1, 10'000));
  path.wait = node.number_or("wait", 0, 0, kLongestRun, "s");
  if (const auto radius = node.find("turn_radius")) read_turn_radius(node, *radius, path);
  return path;
}

PosesPath read_poses(const JsonNode& node) {
  node.expect_keys({"type", "poses"});
  PosesPath path;
  const JsonNode poses = node.at("poses");
  const std::size_t count = poses.size(1, "poses");
  for (std::size_t i = 0; i < count; ++i) {
    const JsonNode pose = poses.at(i);
    pose.expect_keys({"t", "x", "y", "heading"});
    path.poses.push_back({pose.at("t").number(0, kLongestRun, "s"), pose.at("x").number(-kWorldLimit, kWorldLimit, "m"),
                          pose.at("y").number(-kWorldLimit, kWorldLimit, "m"),
                          pose.at("heading").number(-kWorldLimit, kWorldLimit, "rad")});
    if (i > 0 && path.poses[i].t <= path.poses[i - 1].t) {
      pose.at("t").fail("is not later than the pose before it", "list the poses in order of time");
    }
  }
  return path;
}

double duration_of(const Scene& scene) {
  double duration = 0;
  if (const auto* arc = std::get_if<ArcPath>(&scene.path)) duration = (arc->views - 1) / scene.rate;
  if (const auto* poses = std::get_if<PosesPath>(&scene.path)) duration = poses->poses.back().t;
  if (const auto* path = std::get_if<WaypointPath>(&scene.path)) {
    constexpr double kHalfTurn = 3.15;
    for (std::size_t i = 1; i < path->points.size(); ++i) {
      const Point a = path->points[i - 1];
      const Point b = path->points[i];
      duration += std::hypot(b.x - a.x, b.y - a.y) / path->speed + kHalfTurn / path->turn_rate;
    }
    const Point a = path->points.back();
    const Point b = path->points.front();
    const double closing = std::hypot(b.x - a.x, b.y - a.y) / path->speed + kHalfTurn / path->turn_rate;
    if (path->laps > 0) duration = (duration + closing) * path->laps;
    duration += path->wait;
  }
  return duration;
}

/// {"id": px} of some colours.
void read_edge_bias(const JsonNode& node, const NoiseRow& row, const std::vector<SceneSignature>& signatures,
                    SceneNoise& noise) {
  for (const std::string& key : node.keys()) {
    const auto is_it = [&](const SceneSignature& signature) { return std::to_string(signature.id) == key; };
    const auto known = std::find_if(signatures.begin(), signatures.end(), is_it);
    const JsonNode of = node.at(key);
    if (known == signatures.end()) of.fail("signature " + key + " is not defined", "write the id of a signature");
    noise.edge_bias_of[known->id] = of.number(row.low, row.high, row.unit);
  }
}

}  // namespace

void read_path(const JsonNode& node, Scene& scene) {
  node.expect_object();
  const JsonNode type = node.at("type");
  const std::string word = type.text();
  if (word == "arc") {
    scene.path = read_arc(node);
  } else if (word == "waypoints") {
    scene.path = read_waypoints(node);
  } else if (word == "poses") {
    scene.path = read_poses(node);
  } else {
    const std::string nearest = nearest_word(word, {"arc", "waypoints", "poses"});
    type.fail("unknown path type \"" + word + "\"",
              nearest.empty() ? "write \"arc\", \"waypoints\" or \"poses\"" : "did you mean \"" + nearest + "\"?");
  }
  const double duration = duration_of(scene);
  if (duration > kLongestRun || duration * scene.rate > kMaxFrames) {
    node.fail("the drive takes too long for one recording",
              "keep it below 900000 s and a million frames: raise the speed or lower the camera's rate");
  }
}

std::vector<TimedPose> read_object_path(const JsonNode& node) {
  node.expect_object();
  const JsonNode type = node.at("type");
  if (type.text() != "poses") {
    type.fail("an object cannot move by \"" + type.text() + "\"", "write \"poses\": where it is at which time");
  }
  return read_poses(node).poses;
}

SceneNoise read_noise(const JsonNode& node, const std::vector<SceneSignature>& signatures) {
  std::vector<std::string_view> keys;
  for (const NoiseRow& row : kNoiseRows) keys.push_back(row.key);
  node.expect_keys(keys);
  SceneNoise noise;
  for (const NoiseRow& row : kNoiseRows) {
    const auto there = node.find(row.key);
    if (!there) continue;
    if (row.value == &SceneNoise::edge_bias_px && there->is_object()) {
      read_edge_bias(*there, row, signatures, noise);
    } else {
      noise.*row.value = there->number(row.low, row.high, row.unit);
    }
  }
  if (noise.loss_min > noise.loss_max) {
    node.fail("loss_min is greater than loss_max", "swap them; the defaults are 0.1 and 0.5");
  }
  return noise;
}

SceneOdometry read_odometry(const JsonNode& node) {
  node.expect_keys({"kind", "counts", "wheelbase"});
  SceneOdometry odometry;
  const JsonNode kind = node.at("kind");
  const std::string word = kind.text();
  if (word == "gyro") {
    odometry.kind = SceneOdometry::Kind::kGyro;
  } else if (word == "steering") {
    odometry.kind = SceneOdometry::Kind::kSteering;
  } else {
    kind.fail("unknown kind \"" + word + "\"", "write \"gyro\" or \"steering\"; without \"odometry\" it tells poses");
  }
  odometry.counts = node.at("counts").number(1, 1e6, "/m");
  if (word == "steering") odometry.wheelbase = node.at("wheelbase").number(0.01, 3, "m");
  return odometry;
}

void check_odometry_noise(const JsonNode& noise, const SceneOdometry& odometry) {
  const auto refuse = [&](std::initializer_list<std::string_view> keys, const char* what, const char* remedy) {
    for (const std::string_view key : keys) {
      if (const auto there = noise.find(key)) there->fail(what, remedy);
    }
  };
  if (odometry.of_car()) {
    refuse({"pose_xy", "pose_heading", "drift_turn", "drift_walk"}, "is of poses, and this robot tells none",
           "a car has drift_scale, and gyro_ or steer_ errors");
  }
  if (odometry.kind != SceneOdometry::Kind::kGyro) {
    refuse({"gyro_bias", "gyro_walk", "gyro_noise", "gyro_scale"}, "is of a gyro, and this robot has none",
           "add \"odometry\": {\"kind\": \"gyro\", \"counts\": 2000}");
  }
  if (odometry.kind != SceneOdometry::Kind::kSteering) {
    refuse({"steer_offset", "steer_scale", "steer_backlash"}, "is of a steering angle, and this robot tells none",
           "add \"odometry\": {\"kind\": \"steering\", \"counts\": 2000, \"wheelbase\": 0.17}");
  }
}

}  // namespace fencepost::host
