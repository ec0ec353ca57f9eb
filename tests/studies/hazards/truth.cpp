#include "tests/studies/hazards/truth.hpp"

#include <algorithm>
#include <limits>

#include "host/geometry/rings.hpp"
#include "host/simulate/world.hpp"

namespace fencepost::test {
namespace {

constexpr double kNearly = 1.5;  // a stop this many times too early is still right
// The same of movers. They are farther away in the same time: two seconds ahead is right, as for alert.ttc_warn.
constexpr double kNearlyOfMovers = 2.5;
constexpr double kAhead = 8;  // s: a thing that is met later is no reason to stop

const host::Polygon& footprint(const host::SceneObject& object, double t, host::Polygon& moved) {
  if (object.path.empty() && !object.from && !object.until) return object.footprint;
  moved = host::footprint_at(object, t);
  return moved;
}

double between(const host::Polygon& a, const host::Polygon& b) {
  double least = std::numeric_limits<double>::infinity();
  for (const host::Point& p : a.outer) {
    least = std::min(least, host::contains(b, p) ? 0 : host::distance_to_outline(p, b.outer));
  }
  for (const host::Point& p : b.outer) {
    least = std::min(least, host::contains(a, p) ? 0 : host::distance_to_outline(p, a.outer));
  }
  return least;
}

}  // namespace

double Truth::distance(std::size_t object, double t, double progress) const {
  host::Polygon moved;
  const host::TimedPose robot = encounter_.route.at(progress);
  return distance_to(footprint(encounter_.scene.objects[object], t, moved), {robot.x, robot.y});
}

double Truth::clearance(std::size_t object, double t, double progress) const {
  const Body& body = encounter_.body;
  if (!body.outline) return std::max(0.0, distance(object, t, progress) - body.radius);
  host::Polygon moved;
  const host::TimedPose robot = encounter_.route.at(progress);
  const host::Polygon outline = host::moved({*body.outline, {}}, robot.heading, {robot.x, robot.y});
  return between(outline, footprint(encounter_.scene.objects[object], t, moved));
}

bool Truth::touches(double t, double progress) const {
  for (std::size_t object = 0; object < encounter_.scene.objects.size(); ++object) {
    if (clearance(object, t, progress) <= kTouching) return true;
  }
  return false;
}

double RunTruth::progress(double t) const {
  const auto index = static_cast<std::size_t>(std::max(0.0, t / kTruthStep));
  const std::vector<double>& steps = history_.progress;
  if (index + 1 >= steps.size()) return steps.back() + t - static_cast<double>(steps.size() - 1) * kTruthStep;
  return steps[index] + (t / kTruthStep - static_cast<double>(index)) * (steps[index + 1] - steps[index]);
}

double RunTruth::distance(double t) const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t o = 0; o < encounter_.scene.objects.size(); ++o) least = std::min(least, distance(o, t));
  return least;
}

template <class Is>
std::optional<double> RunTruth::first(Is is) const {
  for (int i = 0; i * kTruthStep <= history_.end + kTruthStep / 2; ++i) {
    if (is(i * kTruthStep)) return i * kTruthStep;
  }
  return std::nullopt;
}

std::optional<double> RunTruth::first_within(std::size_t object, double metres) const {
  return first([&](double t) { return distance(object, t) <= metres; });
}

std::optional<double> RunTruth::contact(std::size_t object) const {
  return first([&](double t) { return clearance(object, t) <= kTouching; });
}

std::optional<double> RunTruth::meets_in(std::size_t object, double t, double margin) const {
  const double here = progress(t);
  for (double ahead = 0; ahead <= kAhead; ahead += kTruthStep) {
    if (truth_.clearance(object, t + ahead, here + ahead) <= margin) return ahead;
  }
  return std::nullopt;
}

bool RunTruth::stop_is_right(double t, double grace) const {
  const AlertLimits limits;
  for (std::size_t object = 0; object < encounter_.scene.objects.size(); ++object) {
    const auto meets = meets_in(object, t, limits.margin + grace);
    if (!meets) continue;
    const double near = kNearly * limits.stop;
    if (distance(object, t) <= near || clearance(object, t) <= near - limits.half_width) return true;
    const bool moves = !encounter_.scene.objects[object].path.empty();
    if (*meets <= (moves ? kNearlyOfMovers : kNearly) * limits.ttc_stop) return true;
  }
  return false;
}

}  // namespace fencepost::test
