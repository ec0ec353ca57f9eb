#include "firmware/alert/front_alert.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "firmware/recon/floor_frame.hpp"

namespace fencepost::alert {

using recon::guard::Front;
using record::AlertLevel;

namespace {

constexpr std::int32_t kReach = 4000;  // mm

// The squared distance (mm^2) from the robot's origin within which a front calls for a level: ahead, and behind.
struct Limit {
  std::array<std::int32_t, 2> squares{};
  unsigned frames = 0;  // of the fronts within it

  void set(float distance, const Overhang& overhang) {
    squares[0] = square_of(distance + overhang.ahead);
    squares[1] = overhang.behind == overhang.ahead ? squares[0] : square_of(distance + overhang.behind);
  }
  void add(const Front& front, std::int32_t distance_square, bool behind) {
    if (distance_square <= squares[behind ? 1 : 0]) frames |= front.frames;
  }
  static std::int32_t square_of(float distance) {
    const std::int32_t reach = recon::nearest_whole(recon::kMillimetresPerMetre * distance, kReach);
    return reach * reach;
  }
  [[nodiscard]] bool reached() const { return recon::guard::enough_frames(frames); }
};

struct Limits {
  Limit stop;
  Limit warn;

  Limits(const AlertRules& rules, const RobotPath& path, const Overhang& overhang, float slack) {
    const float speed = std::fabs(path.motion.forward);
    const bool closing = speed > kStanding;
    const float until_next_look = closing ? kLookSeconds * speed : 0.0F;
    const auto soon = [&](float ttc) { return closing ? path.body_radius + slack * ttc * speed : 0.0F; };
    stop.set(std::max(slack * rules.stop + kFrontDoubt + until_next_look, soon(rules.ttc_stop)), overhang);
    warn.set(std::max(slack * rules.warn, soon(rules.ttc_warn)), overhang);
  }
  void add(const Front& front, std::int32_t distance_square, bool behind) {
    stop.add(front, distance_square, behind);
    warn.add(front, distance_square, behind);
  }
  [[nodiscard]] std::int32_t widest(bool behind) const {
    return std::max(stop.squares[behind ? 1 : 0], warn.squares[behind ? 1 : 0]);
  }
  [[nodiscard]] AlertLevel level() const {
    if (stop.reached()) return AlertLevel::kStop;
    return warn.reached() ? AlertLevel::kWarn : AlertLevel::kClear;
  }
};

// `square`: of a distance in mm.
float speed_before(std::int32_t square, float overhang, const RobotPath& path, const AlertRules& rules) {
  const float distance = std::sqrt(static_cast<float>(square)) / recon::kMillimetresPerMetre - overhang;
  return stopping_speed(distance - path.body_radius, rules.ttc_stop, distance - kFrontDoubt - rules.stop);
}

float confidence_of(const Front& front) {
  constexpr float kFramesKept = 8;
  constexpr std::int64_t kCounts = recon::guard::kRefutedAfter.raw / recon::guard::kDoubtTicks;
  constexpr auto kRefuted = static_cast<float>(kCounts);
  const float doubt = std::min(1.0F, static_cast<float>(front.doubt) / kRefuted);
  return static_cast<float>(__builtin_popcount(front.frames)) / kFramesKept * (1 - doubt);
}

}  // namespace

FrontAhead see_fronts(std::span<const Front> fronts, recon::MapPoint origin, const RobotPlace& robot,
                      const RobotPath& path, const AlertRules& rules) {
  using recon::nearest_whole;
  constexpr std::int32_t kUnits = recon::kMapUnitsPerMetre / 1000;
  const SweptArea area(path, kUnsureMargin);
  const SweptArea whole(path, 0);
  Limits due(rules, path, area.overhang(), 1.0F);
  Limits held(rules, path, area.overhang(), kHysteresis);
  Limits backs(rules, path, area.overhang(), 1 + kCutOff.most);
  const recon::FloorFrame here{(robot.position.x - origin.x) / kUnits, (robot.position.y - origin.y) / kUnits,
                               nearest_whole(recon::kSlopeOne * robot.heading.x()),
                               nearest_whole(recon::kSlopeOne * robot.heading.y())};
  const Front* nearest = nullptr;
  std::array<std::int32_t, 2> met = {2 * kReach * kReach, 2 * kReach * kReach};  // squares, ahead and behind
  std::int32_t nearest_x = 0;
  std::int32_t nearest_y = 0;
  const std::array<std::int32_t, 2> widest = {held.widest(false), held.widest(true)};
  std::int32_t least = std::max(widest[0], widest[1]);
  bool confirmed = false;
  for (const Front& front : fronts) {
    const std::int32_t dx = front.x - here.x;
    const std::int32_t dy = front.y - here.y;
    if (dx > kReach || dx < -kReach || dy > kReach || dy < -kReach) continue;
    const auto [x, y] = here.see(front.x, front.y);
    if (!whole.contains(x, y)) continue;
    const std::int32_t square = x * x + y * y;
    const bool behind = x < 0;
    backs.add(front, square, behind);
    if (!area.contains(x, y)) continue;
    due.add(front, square, behind);
    held.add(front, square, behind);
    // A point of a single frame may be noise: the nearest one that several have seen, if there is one.
    const bool enough = recon::guard::enough_frames(front.frames);
    if (enough) met[behind ? 1 : 0] = std::min(met[behind ? 1 : 0], square);
    if ((confirmed && !enough) || (confirmed == enough && square > least)) continue;
    if (square > widest[behind ? 1 : 0]) continue;
    confirmed = enough;
    least = square;
    nearest = &front;
    nearest_x = x;
    nearest_y = y;
  }
  FrontAhead ahead;
  ahead.due = due.level();
  ahead.held = held.level();
  ahead.something = backs.level() == AlertLevel::kStop;
  ahead.speed = std::min(speed_before(met[0], area.overhang().ahead, path, rules),
                         speed_before(met[1], area.overhang().behind, path, rules));
  if (nearest == nullptr) return ahead;
  Obstacle& obstacle = ahead.nearest;
  obstacle.known = true;
  obstacle.toward =
      recon::Vec2{static_cast<float>(nearest_x), static_cast<float>(nearest_y)} / recon::kMillimetresPerMetre;
  obstacle.distance = obstacle.toward.norm();
  obstacle.in_path.emplace();
  set_closing(path, obstacle);
  ahead.signature = nearest->signature;
  ahead.confidence = confidence_of(*nearest);
  return ahead;
}

// In whole millimetres of the guard's axes, for floats are slow on small cores: these decide only about points on the
// very edge.
bool front_within(std::span<const Front> fronts, recon::MapPoint origin, const RobotPlace& robot,
                  const recon::Vec2& place, float reach) {
  constexpr std::int32_t kRounding = 2;       // mm: more than all that is rounded
  constexpr std::int32_t kFarthest = 20'000;  // mm: its square fits
  const recon::Vec2 from = recon::offset_from(robot.position, origin);
  const recon::Vec2 middle = recon::rotated(robot.heading, place) - from;
  const std::int32_t x = recon::nearest_whole(recon::kMillimetresPerMetre * middle.x());
  const std::int32_t y = recon::nearest_whole(recon::kMillimetresPerMetre * middle.y());
  const float most = reach + kFrontRadius;
  const std::int32_t edge = recon::nearest_whole(recon::kMillimetresPerMetre * most, kFarthest);
  const std::int32_t outside = edge + kRounding;
  const std::int32_t inside = std::max(edge - kRounding, std::int32_t{0});
  const auto exactly_within = [&](const Front& front) {
    const recon::Vec2 at = robot.see(from + recon::Vec2{metres(front.x), metres(front.y)});
    return (at - place).squared_norm() < most * most;
  };
  unsigned frames = 0;
  for (const Front& front : fronts) {
    const std::int32_t dx = front.x - x;
    const std::int32_t dy = front.y - y;
    if (dx > outside || dx < -outside || dy > outside || dy < -outside) continue;
    const std::int32_t square = dx * dx + dy * dy;
    if (square > outside * outside || (square >= inside * inside && !exactly_within(front))) continue;
    frames |= front.frames;
    if (recon::guard::enough_frames(frames)) return true;
  }
  return false;
}

std::optional<AlertLevel> judge(AlertState& state, const FrontAhead& front, AlertLevel others, const AlertRules& rules,
                                base::Time now) {
  const AlertLevel due = front.due > others ? front.due : std::min(front.due, state.level);
  const AlertLevel before = state.level;
  const std::optional<AlertLevel> level = follow(state, due, front.held, rules, now);
  const bool repeat = level == before;
  return repeat && others >= before ? std::nullopt : level;
}

}  // namespace fencepost::alert
