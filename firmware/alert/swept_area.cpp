#include "firmware/alert/swept_area.hpp"

#include "firmware/alert/tuning.hpp"
#include "firmware/recon/floor_frame.hpp"
#include "firmware/recon/guard/tuning.hpp"

namespace fencepost::alert {
namespace {

bool turns_around_itself(const RobotPath& path, const Ways& ways) {
  return path.has_corners() && (ways.spins || (ways.arc && std::fabs(ways.radius) < path.body_radius));
}

float overhang_of(const RobotPath& path, float length, bool leads) {
  if (!(length > 0)) return 0;
  const float half = path.body_radius;
  const float reach = leads ? length : std::sqrt(length * length + half * half);
  return std::max(0.0F, reach - half);
}

std::int32_t whole_mm2(float square_metres) {
  constexpr float kSquareMillimetres = 1e6F;
  constexpr std::int32_t kMax = 1 << 28;
  return recon::nearest_whole(kSquareMillimetres * square_metres, kMax);
}

}  // namespace

void LastWay::follow(const recon::Motion& motion) {
  const float speed = std::fabs(motion.forward);
  const float turn = std::fabs(motion.turn);
  const bool moves = speed >= kSurelyMoving;
  if (moves) back = motion.forward < 0;
  if (moves || turn >= kSpinning) turning = turn >= kSurelyTurning;
}

Ways::Ways(const RobotPath& path)
    : ahead(path.motion.forward > -kSurelyMoving), behind(path.motion.forward < -kStanding) {
  const float speed = std::fabs(path.motion.forward);
  const float turn = std::fabs(path.motion.turn);
  const bool slow = speed < kSurelyMoving;
  arc = speed > kStanding && turn * kTightestArc < speed && turn * kFlattestArc > speed;
  if (slow && turn < kSurelyTurning) arc = false;
  straight = !arc || slow;
  spins = turn >= kSurelyTurning && turn * kTightestArc >= speed;
  if (arc || spins) radius = path.motion.forward / path.motion.turn;
  if (!slow) return;
  if (path.last.back && path.rear > 0) behind = true;
  if (path.last.turning && path.has_corners() && !arc) spins = true;
}

Overhang::Overhang(const RobotPath& path, const Ways& ways)
    : ahead(overhang_of(path, path.front, ways.ahead && !ways.spins)),
      behind(overhang_of(path, path.rear, ways.behind && !ways.spins)) {}

// The corner is sqrt(side^2 + length^2) from the pivot, where the side is radius + half the width.
Corners::Corners(const RobotPath& path, float margin, float length_m, float radius) : length(length_m) {
  if (!(length > 0)) return;
  const float side = radius + path.body_radius;
  out = std::sqrt(side * side + length * length) - side;
  square = length * length + 2 * margin * out;
}

SweptArea::SweptArea(const RobotPath& path, float less) : sweep_(path), overhang_(path, sweep_.ways) {
  using recon::kMillimetresPerMetre;
  using recon::nearest_whole;
  const float half_width = path.half_width - less;
  const float radius = std::fabs(sweep_.ways.radius);
  sweep_.twice_radius = 2 * nearest_whole(kMillimetresPerMetre * sweep_.ways.radius);
  sweep_.around = turns_around_itself(path, sweep_.ways);
  bounds_ = sweep_.ring(std::max(nearest_whole(kMillimetresPerMetre * half_width), recon::guard::kSpacing / 2));
  if (!path.has_corners()) return;
  bounds_.middle = nearest_whole(kMillimetresPerMetre * 0.5F * path.body_radius);
  const float margin = half_width - path.body_radius;
  const auto add = [&](float length, SweptBounds<std::int32_t>::End& end) {
    const Corners corners(path, margin, length, radius);
    end.beside = nearest_whole(kMillimetresPerMetre * std::max(0.0F, length - margin));
    end.passed = nearest_whole(kMillimetresPerMetre * length);
    end.outer += whole_mm2(corners.square);
  };
  add(path.front, bounds_.front);
  add(path.rear, bounds_.rear);
  bounds_.outer = std::max(bounds_.front.outer, bounds_.rear.outer);
}

SweptByBody::SweptByBody(const RobotPath& path) : path_(path), sweep_(path), overhang_(path, sweep_.ways) {
  const float radius = std::fabs(sweep_.ways.radius);
  sweep_.twice_radius = 2 * sweep_.ways.radius;
  sweep_.around = turns_around_itself(path, sweep_.ways);
  if (!path.has_corners()) return;
  const float margin = path.half_width - path.body_radius;
  front_ = Corners(path, margin, path.front, radius);
  rear_ = Corners(path, margin, path.rear, radius);
}

bool SweptByBody::touches(const recon::Vec2& point, const SweptBounds<float>& bounds) const {
  return sweep_.holds(point.x(), point.y(), bounds);
}

bool SweptByBody::touches(const recon::Vec2& center, float radius) const {
  return center.squared_norm() < radius * radius || touches(center, bounds_of(radius));
}

// A disc is a point, and the margin is wider by its radius.
SweptBounds<float> SweptByBody::bounds_of(float radius) const {
  SweptBounds<float> bounds = sweep_.ring(path_.half_width + radius);
  if (path_.has_corners()) {
    bounds.middle = 0.5F * path_.body_radius;
    const float margin = path_.half_width - path_.body_radius + radius;
    const auto add = [&](const Corners& corners, SweptBounds<float>::End& end) {
      if (!(corners.length > 0)) return;
      end.beside = std::max(0.0F, corners.length - margin);
      end.passed = corners.length + radius;
      end.outer += corners.square + 2 * radius * corners.out;
    };
    add(front_, bounds.front);
    add(rear_, bounds.rear);
    bounds.outer = std::max(bounds.front.outer, bounds.rear.outer);
  }
  return bounds;
}

}  // namespace fencepost::alert
