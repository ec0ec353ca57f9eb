#include "host/simulate/world.hpp"

#include <algorithm>
#include <utility>

#include "host/geometry/rings.hpp"
#include "host/simulate/trajectory.hpp"

namespace fencepost::host {

namespace {

bool changes(const SceneObject& object) { return !object.path.empty() || object.from || object.until; }

}  // namespace

Polygon footprint_at(const SceneObject& object, double t) {
  if ((object.from && t < *object.from) || (object.until && t >= *object.until)) return {};
  if (object.path.empty()) return object.footprint;
  const std::vector<TimedPose> knots = continuous(object.path);
  const TimedPose& first = knots.front();
  const TimedPose now = pose_between(knots, t);
  Polygon own = moved(object.footprint, 0, {-first.x, -first.y});
  return moved(std::move(own), now.heading - first.heading, {now.x, now.y});
}

World::World(const Scene& scene)
    : scene_(scene), still_(std::none_of(scene.objects.begin(), scene.objects.end(), changes)) {
  if (!still_) objects_ = scene.objects;
}

const std::vector<SceneObject>& World::at(double t) {
  if (still_) return scene_.objects;
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    if (changes(scene_.objects[i])) objects_[i].footprint = footprint_at(scene_.objects[i], t);
  }
  return objects_;
}

}  // namespace fencepost::host
