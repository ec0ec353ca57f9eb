// One reader for each part of a scene file. They throw SceneProblem.
#pragma once

#include "host/scene/json_reader.hpp"
#include "host/scene/scene.hpp"

namespace fencepost::host {

void read_camera(const JsonNode& node, Scene& scene);
SceneSignature read_signature(const JsonNode& node);
SceneObject read_object(const JsonNode& node, std::size_t index);
/// Polygon (closed or open rings, holes allowed) or {"circle": [x, y, r]}; valid, oriented, rings open.
Polygon read_footprint(const JsonNode& node);
void read_path(const JsonNode& node, Scene& scene);
SceneNoise read_noise(const JsonNode& node);

}  // namespace fencepost::host
