#include "host/scene/load.hpp"

#include <algorithm>
#include <vector>

#include "host/geometry/planar.hpp"
#include "host/scene/read_scene.hpp"

namespace fencepost::host {

namespace {

void check_signatures(const JsonNode& root, const Scene& scene) {
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    if (!scene.objects[i].trained) continue;
    const auto known = std::any_of(scene.signatures.begin(), scene.signatures.end(),
                                   [&](const SceneSignature& s) { return s.id == scene.objects[i].signature; });
    if (known) continue;
    root.at("objects")
        .at(i)
        .at("signature")
        .fail("signature " + std::to_string(scene.objects[i].signature) + " is not defined",
              "add it to \"signatures\"");
  }
}

bool meet_in_time(const SceneObject& a, const SceneObject& b) {
  const auto ends_first = [](const SceneObject& first, const SceneObject& second) {
    return first.until && second.from && *first.until <= *second.from;
  };
  return !ends_first(a, b) && !ends_first(b, a);
}

struct Box {
  double left = 0;
  double right = 0;
  double low = 0;
  double high = 0;
};

Box box_of(const LinearRing& ring) {
  const auto [left, right] = std::minmax_element(ring.begin(), ring.end(), [](Point a, Point b) { return a.x < b.x; });
  const auto [low, high] = std::minmax_element(ring.begin(), ring.end(), [](Point a, Point b) { return a.y < b.y; });
  return {left->x, right->x, low->y, high->y};
}

bool meet(const Box& a, const Box& b) {
  return a.left <= b.right && b.left <= a.right && a.low <= b.high && b.low <= a.high;
}

/// Solids must not overlap: parts of them would be invisible to every camera. Where one moves, nobody looks.
void check_overlaps(const JsonNode& root, const Scene& scene) {
  constexpr double kSliver = 1e-8;  // m^2; touching faces are fine
  constexpr double kTouch = 1e-9;   // m
  std::vector<Box> boxes;
  for (const SceneObject& object : scene.objects) boxes.push_back(box_of(object.footprint.outer));
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (!meet(boxes[k], boxes[i])) continue;
      const SceneObject& a = scene.objects[k];
      const SceneObject& b = scene.objects[i];
      if (!a.path.empty() || !b.path.empty() || !meet_in_time(a, b)) continue;
      if (a.base + a.height_m <= b.base + kTouch || b.base + b.height_m <= a.base + kTouch) continue;
      if (intersection_area({a.footprint}, {b.footprint}) <= kSliver) continue;
      root.at("objects")
          .at(i)
          .at("footprint")
          .fail("\"" + b.name + "\" overlaps \"" + a.name + "\" in the plane and in height", "move one of them");
    }
  }
}

Scene read_scene(const JsonNode& root) {
  root.expect_keys({"format", "seed", "camera", "robot", "signatures", "objects", "path", "odometry", "noise"});
  const JsonNode format = root.at("format");
  if (format.integer(0, 1'000'000) != 1) format.fail("this program reads scene format 1", "write 1");
  Scene scene;
  if (const auto seed = root.find("seed")) scene.seed = seed->unsigned_integer();
  read_camera(root.at("camera"), scene);
  if (const auto robot = root.find("robot")) scene.robot = read_robot_body(*robot);
  scene.signatures = read_signatures(root.at("signatures"));
  const JsonNode objects = root.at("objects");
  constexpr std::size_t kMaxObjects = 10'000;
  const std::size_t object_count = objects.size(0, "objects");
  if (object_count > kMaxObjects) objects.fail("there are more than 10000 objects", "use fewer");
  for (std::size_t i = 0; i < object_count; ++i) scene.objects.push_back(read_object(objects.at(i), i));
  check_signatures(root, scene);
  check_overlaps(root, scene);
  if (const auto path = root.find("path")) read_path(*path, scene);
  if (const auto odometry = root.find("odometry")) scene.odometry = read_odometry(*odometry);
  if (const auto noise = root.find("noise")) {
    scene.noise = read_noise(*noise, scene.signatures);
    check_odometry_noise(*noise, scene.odometry);
  }
  return scene;
}

}  // namespace

std::string SceneError::message() const {
  std::string text = file;
  if (!where.empty()) text += ": " + where;
  return text + ": " + what + "; " + remedy;
}

LoadedScene parse_scene(std::string_view text, const std::string& name) {
  try {
    return read_scene(JsonText(text, "share/doc/scene.md shows a whole scene").root());
  } catch (const SceneProblem& problem) {
    return SceneError{name, problem.where, problem.what, problem.remedy};
  }
}

}  // namespace fencepost::host
