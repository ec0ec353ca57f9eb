#include "firmware/alert/free_ways.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/alert/known_room.hpp"
#include "firmware/recon/floor_frame.hpp"
#include "hal/base/trig.hpp"

namespace fencepost::alert {
namespace {

using recon::Vec2;
using record::WayEnd;
using record::WayMotion;

struct WayShape {
  WayMotion motion;
  float curvature;  // 1/m, positive to the left
};
// On the spot, forward from the left to the right, back. The sharpest radius is twice kTightestArc.
constexpr std::array<WayShape, FreeWays::kWays> kShapes = {{{WayMotion::kSpin, 0},
                                                            {WayMotion::kForward, 3.2F},
                                                            {WayMotion::kForward, 1.6F},
                                                            {WayMotion::kForward, 0.8F},
                                                            {WayMotion::kForward, 0},
                                                            {WayMotion::kForward, -0.8F},
                                                            {WayMotion::kForward, -1.6F},
                                                            {WayMotion::kForward, -3.2F},
                                                            {WayMotion::kBack, 0}}};

constexpr float kLongest = kFarthestKnown;
// A mask of every way.
constexpr unsigned kAll = ~0U;

// m, or rad: as far as the way is followed, half a turn at most.
float longest(const WayShape& shape) {
  if (shape.motion == WayMotion::kSpin) return base::kPi;
  return shape.curvature == 0 ? kLongest : std::min(kLongest, base::kPi / std::fabs(shape.curvature));
}

// rad. The arcsine of opposite / longest, both not negative; a quarter turn where that is 1 or more.
float arc_sine(float opposite, float longest) {
  if (!(opposite < longest)) return 0.5F * base::kPi;
  return base::atan2_rad(opposite, std::sqrt(longest * longest - opposite * opposite));
}

// m from the origin to the end that leads. A round end is a half circle of the body's width.
float lead_of(const RobotPath& body, WayMotion motion) {
  const float straight = motion == WayMotion::kBack ? body.rear : body.front;
  return std::max(straight, body.body_radius);
}

// m from the origin to the farthest corner.
float reach_of(const RobotPath& body) {
  if (!body.has_corners()) return body.body_radius;
  const float longest = std::max(body.front, body.rear);
  return std::sqrt(body.body_radius * body.body_radius + longest * longest);
}

// The body as a rectangle, with its margin at the sides, moved out by the radius of a disc: the disc is a point then.
struct Grown {
  Grown(const RobotPath& body, WayMotion motion, float radius)
      : lead(lead_of(body, motion) + radius),
        tail((motion == WayMotion::kBack ? body.front : body.rear) + radius),
        side(body.half_width + radius),
        beside(body.body_radius + radius),
        end(lead - radius) {}
  // x counts towards the end that leads.
  [[nodiscard]] bool along(float x) const { return x <= lead && x >= -tail; }
  [[nodiscard]] bool holds(float x, float y) const { return along(x) && y <= side && y >= -side; }

  float lead;
  float tail;
  float side;
  float beside;  // of the body without its margin
  float end;     // of the body itself
};

// m until the body touches a point, straight on. What is within its margin but beside it is passed.
float straight_until(const Grown& body, float x, float y) {
  const float aside = std::fabs(y);
  if (aside > body.side || x <= 0) return kLongest;
  if (x <= body.end && aside >= body.beside) return kLongest;
  return std::max(0.0F, x - body.lead);
}

// The same on an arc to the left with that radius. As the body sees it, the point goes backwards around the pivot. It
// enters by the front, by the inner side, or by the outer one, which is what a tail swings out.
float arc_until(const Grown& body, float turn, float x, float y) {
  const float square = x * x + (turn - y) * (turn - y);
  const float inner = std::max(0.0F, turn - body.side);
  const float outer = turn + body.side;
  const float longest_end = std::max(body.lead, body.tail);
  if (square < inner * inner || square > outer * outer + longest_end * longest_end) return kLongest;
  if (body.holds(x, y)) {
    const bool nears = (x > 0) == (y > 0) || (x > 0 && std::fabs(y) < body.beside);
    return nears ? 0.0F : kLongest;
  }
  const float distance = std::sqrt(square);
  const float angle = base::atan2_rad(x, turn - y);
  float until = kLongest;
  // It enters where it has this x and y.
  const auto enter = [&](float at_x, float at_y, bool valid) {
    if (!valid) return;
    const float gone = angle - base::atan2_rad(at_x, turn - at_y);
    until = std::min(until, turn * (gone < 0 ? gone + 2 * base::kPi : gone));
  };
  const auto other_leg = [&](float leg) { return std::sqrt(std::max(0.0F, square - leg * leg)); };
  const float front_y = turn - other_leg(body.lead);
  enter(body.lead, front_y, distance >= body.lead && std::fabs(front_y) <= body.side);
  const float inner_x = other_leg(turn - body.side);
  enter(inner_x, body.side, distance >= std::fabs(turn - body.side) && body.along(inner_x));
  const float outer_x = -other_leg(outer);
  enter(outer_x, -body.side, distance >= outer && body.along(outer_x));
  return until;
}

// m until the body comes up to something that it would pass on the wrong side; robot frame, y to the left of the way.
float wrong_side_until(const RobotPath& body, float curvature, const Vec2& center, PassingSide side) {
  if (side == PassingSide::kAny || !(center.x() > 0)) return kLongest;
  const float lead = lead_of(body, WayMotion::kForward);
  float left = center.y();  // of the way, m
  float along = center.x() - lead;
  if (curvature != 0) {
    const float turn = 1 / std::fabs(curvature);
    const float sign = curvature > 0 ? 1.0F : -1.0F;
    const Vec2 away{center.x(), turn - sign * center.y()};
    const float distance = away.norm();
    left = sign * (turn - distance);
    along = turn * (base::atan2_rad(away.x(), away.y()) - arc_sine(lead, distance));
  }
  const bool passes_on_its_right = left > 0;
  const bool right = passes_on_its_right == (side == PassingSide::kRight);
  return right || std::fabs(left) > kLongest ? kLongest : std::max(0.0F, along);
}

}  // namespace

FreeWays::FreeWays(const RobotPath& body) : body_(body), reach_(reach_of(body)) {
  for (std::size_t k = 0; k < kWays; ++k) until_[k] = longest(kShapes[k]);
}

float FreeWays::until(std::size_t index, const Vec2& center, float radius) const {
  const WayShape& shape = kShapes[index];
  if (shape.motion == WayMotion::kSpin) {
    // A round body stays in its own place; a corner does not.
    const float room = reach_ + body_.half_width - body_.body_radius + radius;
    return body_.has_corners() && center.squared_norm() < room * room ? 0.0F : base::kPi;
  }
  const Grown body(body_, shape.motion, radius);
  if (shape.motion == WayMotion::kBack) return straight_until(body, -center.x(), center.y());
  if (shape.curvature == 0) return straight_until(body, center.x(), center.y());
  const float sign = shape.curvature < 0 ? -1.0F : 1.0F;
  return arc_until(body, sign / shape.curvature, center.x(), sign * center.y());
}

// No way is shorter than the straight line to what ends it.
void FreeWays::put(const Vec2& center, float radius, unsigned mask) {
  const float margin = body_.half_width - body_.body_radius;
  const float gap = center.norm() - radius - reach_ - margin;
  for (std::size_t k = 0; k < kWays; ++k) {
    if ((mask >> k & 1U) == 0 || gap >= until_[k]) continue;
    until_[k] = std::min(until_[k], until(k, center, radius));
  }
}

unsigned FreeWays::met_by(const Vec2& center, float radius) const {
  unsigned mask = 0;
  for (std::size_t k = 0; k < kWays; ++k) mask |= until(k, center, radius) < until_[k] ? 1U << k : 0U;
  return mask;
}

void FreeWays::pass(const Vec2& center, PassingSide side) {
  for (std::size_t k = 0; k < kWays; ++k) {
    if (kShapes[k].motion != WayMotion::kForward) continue;
    until_[k] = std::min(until_[k], wrong_side_until(body_, kShapes[k].curvature, center, side));
  }
}

void FreeWays::add(std::span<const recon::guard::Front> fronts, recon::MapPoint origin, const RobotPlace& odometry) {
  const Vec2 from = recon::offset_from(odometry.position, origin);
  for (const recon::guard::Front& front : fronts) {
    const Vec2 place = Vec2{static_cast<float>(front.x), static_cast<float>(front.y)} / recon::kMillimetresPerMetre;
    put(odometry.see(from + place), kFrontRadius, kAll);
  }
}

void FreeWays::add_cylinder(const recon::ObjectCore& object, const RobotPlace& robot, PassingSide side) {
  const recon::CylinderEstimate& cylinder = object.cylinder.estimate();
  if (!cylinder.ok()) return;
  const Vec2 center = recon::offset_from(robot.position, object.origin) + cylinder.center;
  const Vec2 ahead = robot.see(center);
  put(ahead, cylinder.radius + kNearer * cylinder.outline_sigma(), kAll);
  if (side != PassingSide::kAny) pass(ahead, side);
}

void FreeWays::add_outline(const recon::PlacedOutline& outline, const RobotPlace& robot, PassingSide side) {
  const Vec2 center = recon::offset_from(robot.position, outline.origin);
  const Vec2 ahead = robot.see(center);
  const std::size_t sides = outline.view.offsets.size();
  const float reach = reach_of(outline.view);
  if (ahead.max_norm() - reach > 2 * kLongest) return;
  const float nearer = kNearer * outline.view.mean_sigma();
  if (side != PassingSide::kAny) pass(ahead, side);
  const unsigned met = met_by(ahead, reach + nearer);
  if (met == 0) return;
  Vec2 before = ahead + robot.see(outline.view.corner(sides - kSidesApart));
  for (std::size_t k = 0; k < sides; k += kSidesApart) {
    const Vec2 corner = ahead + robot.see(outline.view.corner(k));
    const Vec2 edge = corner - before;
    const float length = edge.norm();
    const int pieces = pieces_of(length);
    const Vec2 step = edge / static_cast<float>(pieces);
    for (int i = 0; i < pieces; ++i) {
      put(before + (static_cast<float>(i) + 0.5F) * step, 0.5F * length / static_cast<float>(pieces) + nearer, met);
    }
    before = corner;
  }
}

// The floor under the edge of the body that leads, between its middle and either end.
float FreeWays::seen_until(std::size_t index, float until, const recon::guard::SeenFloor& floor,
                           const RobotPlace& odometry) const {
  const WayShape& shape = kShapes[index];
  const bool spins = shape.motion == WayMotion::kSpin;
  const float sign = shape.motion == WayMotion::kBack ? -1.0F : 1.0F;
  const float lead = spins ? reach_ : lead_of(body_, shape.motion);
  const float known = body_.half_width + metres(kBesideBody);
  const float step = spins ? metres(kFloorStep) / lead : metres(kFloorStep);
  const auto turned = static_cast<std::int64_t>(1e6F * step * (spins ? 1.0F : shape.curvature));
  const base::SinCos turn = base::sincos_urad(turned);
  constexpr std::int32_t kUnitsPerMm = recon::kMapUnitsPerMetre / 1000;
  const std::int32_t x = odometry.position.x / kUnitsPerMm;
  const std::int32_t y = odometry.position.y / kUnitsPerMm;
  const Vec2 axis = recon::kMillimetresPerMetre * odometry.heading;
  const auto seen = [&](const Vec2& place) {
    if (place.squared_norm() <= known * known) return true;
    const Vec2 away = recon::rotated(axis, place);
    return floor.seen(x + static_cast<std::int32_t>(away.x()), y + static_cast<std::int32_t>(away.y()));
  };
  Vec2 place{0, 0};
  Vec2 heading{1, 0};
  float free = 0;
  float gone = 0;
  while (gone < until) {
    const Vec2 ahead = place + sign * lead * heading;
    const Vec2 aside = spins ? Vec2{0, 0} : 0.5F * body_.body_radius * recon::left_of(heading);
    const bool all = spins ? seen(ahead) && seen(-ahead) : seen(ahead + aside) && seen(ahead - aside);
    if (!all) return free;
    free = gone;
    gone += step;
    const Vec2 next = recon::rotated({turn.cos, turn.sin}, heading);
    if (!spins) place += 0.5F * sign * step * (heading + next);
    heading = next;
  }
  return until;
}

record::WayReport::Way FreeWays::way(std::size_t index, const recon::guard::SeenFloor& floor,
                                     const RobotPlace& odometry, const AlertRules& rules) const {
  const WayShape& shape = kShapes[index];
  const bool spins = shape.motion == WayMotion::kSpin;
  const float until = until_[index];
  WayEnd end = until < longest(shape) ? WayEnd::kThing : WayEnd::kNothing;
  const float needed = end == WayEnd::kThing && !spins ? std::max(0.0F, until - metres(kHiddenFloor)) : until;
  const float seen = seen_until(index, needed, floor, odometry);
  const bool unknown = seen < needed;
  if (unknown) end = WayEnd::kUnknown;
  const float free = unknown ? (spins ? 0.0F : seen) : until;
  // A turn on the spot comes no nearer to alert.stop.
  const float before_stop = spins ? free : free + body_.body_radius - rules.stop;
  const float speed = stopping_speed(free, rules.ttc_stop, before_stop);
  return {shape.motion,
          {recon::nearest_whole(static_cast<float>(base::Ratio2::kPerUnit) * shape.curvature)},
          {recon::nearest_whole(static_cast<float>(base::Metres::kPerUnit) * free)},
          {recon::nearest_whole(static_cast<float>(base::Metres::kPerUnit) * speed)},
          end};
}

}  // namespace fencepost::alert
