// One reader for each part of a scene file. They throw SceneProblem.
#pragma once

#include "host/scene/json_reader.hpp"
#include "host/scene/scene.hpp"

namespace fencepost::host {

void read_camera(const JsonNode& node, Scene& scene);
/// At least `least`, each number once.
std::vector<SceneSignature> read_signatures(const JsonNode& node, std::size_t least = 0);
SceneObject read_object(const JsonNode& node, std::size_t index);
/// Polygon (closed or open rings, holes allowed) or {"circle": [x, y, r]}; valid, oriented, rings open.
Polygon read_footprint(const JsonNode& node);
/// A list of corners, closed or open; valid, in the order that is written, open.
LinearRing read_outline(const JsonNode& node);
/// "robot": front, rear and width, or a footprint.
RobotBody read_robot_body(const JsonNode& node);
void read_path(const JsonNode& node, Scene& scene);
/// Poses of an object.
std::vector<TimedPose> read_object_path(const JsonNode& node);
/// Times lie between 0 and this, s; the stream's clock ends at 999999.
inline constexpr double kLongestRun = 900'000;
/// `signatures`: of the scene; its noise may differ from one to the next.
SceneNoise read_noise(const JsonNode& node, const std::vector<SceneSignature>& signatures);
SceneOdometry read_odometry(const JsonNode& node);
/// Errors of poses are none of a car's readings, and the other way round.
void check_odometry_noise(const JsonNode& noise, const SceneOdometry& odometry);

}  // namespace fencepost::host
