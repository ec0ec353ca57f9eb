#include "firmware/alert/sectors.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/alert/known_room.hpp"
#include "firmware/recon/models/hybrid/node_directions.hpp"
#include "firmware/recon/models/hybrid/sector_store.hpp"
#include "hal/base/trig.hpp"

namespace fencepost::alert {
namespace {

using recon::Vec2;

constexpr std::int32_t kUnitsPerMm = recon::kMapUnitsPerMetre / 1000;
// m. What reaches no farther from its middle has one range: that of its nearest point.
constexpr float kSmall = 0.25F;
// m, maximum distance of an object's nearest point: a farther one changes no range.
constexpr float kFarthest = 0.001F * static_cast<float>(kLongestRange) + kSmall;

std::int16_t whole(float range) {
  return static_cast<std::int16_t>(std::clamp(1000.0F * range, 0.0F, static_cast<float>(INT16_MAX)));
}

// The sector in which a place is. An eighth of a turn ends at the border of a sector.
std::size_t sector_of(const Vec2& place) {
  constexpr float kBorders[] = {0.0874887F, 0.267949F, 0.466308F, 0.700208F};  // tan 5, 15, 25, 35 degrees
  constexpr std::size_t kQuarter = kSectors / 4;
  const float along = std::fabs(place.x());
  const float aside = std::fabs(place.y());
  const float more = std::max(along, aside);
  const float less = std::min(along, aside);
  std::size_t in_eighth = less > kBorders[1] * more ? 2 : 0;
  if (less > kBorders[in_eighth] * more) ++in_eighth;
  if (in_eighth == 3 && less > kBorders[3] * more) ++in_eighth;
  const std::size_t in_quarter = aside > along ? kQuarter - in_eighth : in_eighth;
  const std::size_t in_half = place.x() < 0 ? 2 * kQuarter - in_quarter : in_quarter;
  return place.y() < 0 ? (kSectors - in_half) % kSectors : in_half;
}

}  // namespace

Sectors::Sectors(const recon::guard::SeenFloor& floor, const recon::MapPose& odometry, std::int32_t body)
    : odometry_(odometry) {
  near_.fill(static_cast<std::int16_t>(kNothing));
  const std::int32_t x = odometry.position.x / kUnitsPerMm;
  const std::int32_t y = odometry.position.y / kUnitsPerMm;
  // Along the middle of each sector and both its borders; no border reaches farther than the middles beside it.
  const base::SinCos half = base::sincos_urad(3'141'593 / static_cast<std::int64_t>(kSectors));
  const Vec2 step = recon::rotated({half.cos, half.sin}, Vec2{half.cos, half.sin});
  Vec2 direction = odometry_.heading;
  const auto seen_along = [&](const Vec2& axis) {
    const recon::FloorFrame ray{x, y, static_cast<std::int32_t>(recon::kSlopeOne * axis.x()),
                                static_cast<std::int32_t>(recon::kSlopeOne * axis.y())};
    return static_cast<std::int16_t>(floor.seen_along(ray, body + kBesideBody, kFloorStep));
  };
  for (std::int16_t& middle : free_) {
    middle = seen_along(direction);
    direction = recon::rotated(step, direction);
  }
  direction = recon::rotated({half.cos, half.sin}, direction);
  std::array<std::int16_t, kSectors> border{};  // between a sector and the next one
  for (std::size_t k = 0; k < kSectors; ++k) {
    if (free_[k] != 0 || free_[(k + 1) % kSectors] != 0) border[k] = seen_along(direction);
    direction = recon::rotated(step, direction);
  }
  for (std::size_t k = 0; k < kSectors; ++k) {
    free_[k] = std::min({border[(k + kSectors - 1) % kSectors], free_[k], border[k]});
  }
}

// From one place counter-clockwise to the other, less than half a turn.
void Sectors::put(const Vec2& right, const Vec2& left, float range) {
  const std::int16_t kept = whole(range);
  const std::size_t last = sector_of(left);
  for (std::size_t k = sector_of(right);; k = (k + 1) % kSectors) {
    near_[k] = std::min(near_[k], kept);
    if (k == last) return;
  }
}

// All that is within `radius` of a place, robot frame.
void Sectors::put_around(const Vec2& center, float radius, float range) {
  const float square = center.squared_norm();
  if (square <= radius * radius) return near_.fill(0);
  // The points where rays touch the circle, or a little wider.
  const Vec2 middle = (1.0F - radius * radius / square) * center;
  const Vec2 aside = radius / std::sqrt(square) * recon::left_of(center);
  put(middle - aside, middle + aside, range);
}

void Sectors::add(std::span<const recon::guard::Front> fronts, recon::MapPoint origin) {
  const Vec2 from = recon::offset_from(odometry_.position, origin);
  for (const recon::guard::Front& front : fronts) {
    const Vec2 place = odometry_.see(from + Vec2{metres(front.x), metres(front.y)});
    const float square = place.squared_norm();
    if (square > kFarthest * kFarthest) continue;
    const float distance = std::sqrt(square);
    if (distance <= kFrontRadius) return near_.fill(0);
    const Vec2 aside = kFrontRadius / distance * recon::left_of(place);
    put(place - aside, place + aside, distance - kFrontRadius);
  }
}

void Sectors::add_cylinder(const recon::ObjectCore& object, const RobotPlace& robot) {
  const recon::CylinderEstimate& cylinder = object.cylinder.estimate();
  if (!cylinder.ok()) return;
  const Vec2 center = recon::offset_from(robot.position, object.origin) + cylinder.center;
  const float distance = center.norm() - cylinder.radius;
  put_around(robot.see(center), cylinder.radius, distance - kNearer * cylinder.outline_sigma());
}

void Sectors::add_outline(const recon::PlacedOutline& outline, const RobotPlace& robot) {
  const Vec2 center = recon::offset_from(robot.position, outline.origin);
  const float square = center.squared_norm();
  const bool far = square > kFarthest * kFarthest;
  const float reach = reach_of(outline.view);
  if (far && reach < kSmall) return;
  const Vec2 ahead = robot.see(center);
  if (reach > kSmall) {
    std::size_t nearest = 0;
    if (outline.view.distance_from(-center, nearest) < 0) return near_.fill(0);  // the robot is inside
    return add_sides(outline.view, ahead, robot, kNearer * outline.view.mean_sigma());
  }
  // No part of it is nearer than the line that touches it there.
  const std::size_t sides = outline.view.offsets.size();
  const std::size_t one = recon::place_of(Vec2(-center), sides).sector;
  const std::size_t other = one + 1 == sides ? 0 : one + 1;
  const float toward = std::max(outline.view.offset(one), outline.view.offset(other));
  const float sigma = std::max(outline.view.sigma(one), outline.view.sigma(other));
  put_around(ahead, reach, std::sqrt(square) - toward - kNearer * sigma);
}

// Each of its sides by the nearer end; long ones in pieces.
void Sectors::add_sides(const recon::OutlineView& outline, const Vec2& center, const RobotPlace& robot, float nearer) {
  const std::size_t sides = outline.offsets.size();
  Vec2 before = center + robot.see(outline.corner(sides - 1));
  float distance = before.norm();
  for (std::size_t k = 0; k < sides; ++k) {
    const Vec2 corner = center + robot.see(outline.corner(k));
    const Vec2 side = corner - before;
    const float length = std::fabs(side.x()) + std::fabs(side.y());
    const int pieces = pieces_of(length);
    const Vec2 step = side / static_cast<float>(pieces);
    for (int i = 1; i <= pieces; ++i) {
      const Vec2 after = i == pieces ? corner : Vec2(before + step);
      const float then = after.norm();
      const float range = std::min(distance, then) - nearer;
      recon::cross(before, after) > 0 ? put(before, after, range) : put(after, before, range);
      before = after;
      distance = then;
    }
  }
}

std::optional<std::int32_t> Sectors::range(std::size_t sector) const {
  const std::int32_t free = free_[sector];
  const std::int32_t near = near_[sector];
  if (near <= kLongestRange && (free == 0 || near <= free + kHiddenFloor)) return near;
  if (free == 0) return std::nullopt;
  return free;
}

}  // namespace fencepost::alert
