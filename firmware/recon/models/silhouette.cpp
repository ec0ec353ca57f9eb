#include "firmware/recon/models/silhouette.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/recon/models/hybrid/node_directions.hpp"

namespace fencepost::recon {
namespace {

constexpr float kNearest = 1e-3F;  // m

bool in_front(const Vec2& at) { return at.x() > 0 && at.x() * at.x() > kSideways * kSideways * at.squared_norm(); }

// Which nodes have the lens on their outer side, in whole numbers of kOffsetStep: small parts have no floats.
class Facing {
 public:
  static constexpr float kReach = 6.0F;  // m: products of a coordinate that is no larger fit

  Facing(const OutlineView& outline, const Vec2& lens)
      : offsets_(outline.offsets),
        at_{static_cast<std::int32_t>(lens.x() / kOffsetStep), static_cast<std::int32_t>(lens.y() / kOffsetStep)} {}

  [[nodiscard]] std::size_t nodes() const { return offsets_.size(); }
  [[nodiscard]] bool operator()(std::size_t k) const {
    const WholeVector normal = whole_direction(k, nodes());
    return normal.x * at_.x + normal.y * at_.y > offsets_[k] * kWholeUnit;
  }

 private:
  std::span<const std::int16_t> offsets_;
  WholeVector at_;
};

// The nodes that face the lens are one run. The nodes after which it begins (at the left end of the object) and ends.
struct Run {
  static constexpr std::size_t kNone = ~std::size_t{0};
  std::size_t before_first = kNone;
  std::size_t last = kNone;
  [[nodiscard]] bool found() const { return before_first != kNone && last != kNone; }
};

Run facing_run(const Facing& facing) {
  constexpr std::size_t kStride = 4;  // a run is never as short
  Run run;
  bool here = facing(0);
  for (std::size_t k = 0; k < facing.nodes(); k += kStride) {
    const bool ahead = facing(k + kStride < facing.nodes() ? k + kStride : 0);
    if (here != ahead) {
      std::size_t change = k;
      for (std::size_t step = kStride / 2; step > 0; step /= 2) {
        if (facing(change + step) == here) change += step;
      }
      (ahead ? run.before_first : run.last) = change;
    }
    here = ahead;
  }
  return run;
}

float variance_after(const OutlineView& outline, std::size_t k) {
  const float sigma = std::max(outline.sigma(k), outline.sigma(outline.after(k)));
  return sigma * sigma;
}

}  // namespace

bool render(const CylinderEstimate& cylinder, const Vec2& lens, const LensPose& pose, float others, Silhouette& seen) {
  const Vec2 away = cylinder.center - lens;
  const float distance = away.norm();
  if (!(distance > cylinder.radius * 1.01F) || !(distance > kNearest)) return false;
  const Vec2 bearing = to_camera(pose, away / distance);
  if (!(bearing.x() > kSideways)) return false;
  const float sine = cylinder.radius / distance;
  const float cosine = std::sqrt(1.0F - sine * sine);
  const Vec2 along = cosine * bearing;
  const Vec2 aside = sine * left_of(bearing);
  const Vec2 left = along + aside;
  const Vec2 right = along - aside;
  const float reach = distance * cosine;
  // Each end by its own uncertainty: an object seen from one side only has one good end.
  seen.left = {reach * left, cylinder.covariance.along(left_of(to_map(pose, left))) + others};
  seen.right = {reach * right, cylinder.covariance.along(-left_of(to_map(pose, right))) + others};
  seen.depth = std::max(kNearest, bearing.x() * distance - cylinder.radius);
  return true;
}

bool render(const OutlineView& outline, const Vec2& lens, const LensPose& pose, float others, Silhouette& seen) {
  if (!(std::max(std::fabs(lens.x()), std::fabs(lens.y())) < Facing::kReach)) return false;
  const Run run = facing_run(Facing(outline, lens));
  if (!run.found()) return false;
  const Vec2 left = to_camera(pose, outline.corner(run.before_first) - lens);
  const Vec2 right = to_camera(pose, outline.corner(run.last) - lens);
  if (!in_front(left) || !in_front(right)) return false;
  seen.left = {left, variance_after(outline, run.before_first) + others};
  seen.right = {right, variance_after(outline, run.last) + others};
  const std::size_t front = nearest_node(-pose.axis, outline.offsets.size());
  seen.depth = std::max(kNearest, -outline.offset(front) - pose.axis.dot(lens));
  return true;
}

}  // namespace fencepost::recon
