#include "host/report/map_frame.hpp"

#include <algorithm>
#include <cmath>

namespace fencepost::host {
namespace {

constexpr double kTallest = 640;       ///< px
constexpr double kFlattest = 300;      ///< px
constexpr double kSmallestView = 0.5;  ///< m
constexpr double kAir = 0.08;          ///< share of the extent, each side

struct Bounds {
  bool any = false;
  Point low;
  Point high;

  void add(Point p) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) return;
    if (!any) low = high = p;
    any = true;
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  void add(const Polygon& polygon) {
    for (const Point& p : polygon.outer) add(p);
  }
};

void add_objects(Bounds& bounds, const ResultDocument& document, bool tentative) {
  for (const ObjectResult& object : document.objects) {
    if ((object.state == record::ObjectState::kTentative) != tentative) continue;
    for (const ModelResult& model : object.models) {
      for (const Polygon& polygon : model.geometry) bounds.add(polygon);
    }
  }
}

}  // namespace

MapFrame fit_map(const ResultDocument& document, const std::optional<Scene>& truth) {
  Bounds bounds;
  for (const PoseResult& pose : document.path) bounds.add(Point{pose.x, pose.y});
  if (truth) {
    for (const SceneObject& object : truth->objects) bounds.add(object.footprint);
  }
  add_objects(bounds, document, false);
  if (!bounds.any) add_objects(bounds, document, true);

  const double wide = std::max(bounds.high.x - bounds.low.x, kSmallestView) * (1 + 2 * kAir);
  const double tall = std::max(bounds.high.y - bounds.low.y, kSmallestView) * (1 + 2 * kAir);
  MapFrame frame;
  frame.centre = {(bounds.low.x + bounds.high.x) / 2, (bounds.low.y + bounds.high.y) / 2};
  frame.scale = std::min(frame.width / wide, kTallest / tall);
  frame.height = std::clamp(tall * frame.scale, kFlattest, kTallest);
  return frame;
}

}  // namespace fencepost::host
