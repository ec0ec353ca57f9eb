#include "host/web/drive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "host/geometry/rings.hpp"
#include "host/simulate/world.hpp"

namespace fencepost::host {
namespace {

constexpr double kAcceleration = 1.0;      // m/s^2, of a small robot on a smooth floor
constexpr double kTurnAcceleration = 8.0;  // rad/s^2
constexpr double kKept = 12;               // s of the true way: a frame is at most 10 s late
constexpr double kClearance = 0.15;        // m: what begins above it does not touch a small robot
constexpr double kLeft = 0.02;             // m from where it bumped into something: the next one counts anew
const double kPeriod = kOdometryPeriod.to_double();

double towards(double now, double wanted, double step) { return now + std::clamp(wanted - now, -step, step); }

LinearRing body_of(const RobotBody& body) {
  if (!body.footprint.empty()) return body.footprint;
  const double width = body.width.value_or(0.2);
  const double front = body.front.value_or(width / 2);
  const double rear = body.rear.value_or(width / 2);
  return {{front, width / 2}, {-rear, width / 2}, {-rear, -width / 2}, {front, -width / 2}};
}

bool cross(Point a, Point b, Point c, Point d) {
  const auto side = [](Point p, Point q, Point r) { return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x); };
  return (side(a, b, c) > 0) != (side(a, b, d) > 0) && (side(c, d, a) > 0) != (side(c, d, b) > 0);
}

bool outlines_cross(const LinearRing& a, const LinearRing& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t k = 0; k < b.size(); ++k) {
      if (cross(a[i], a[(i + 1) % a.size()], b[k], b[(k + 1) % b.size()])) return true;
    }
  }
  return false;
}

bool meet(const Polygon& a, const Polygon& b) {
  if (a.outer.empty() || b.outer.empty()) return false;
  return outlines_cross(a.outer, b.outer) || contains(a, b.outer.front()) || contains(b, a.outer.front());
}

}  // namespace

MapScore map_score(const std::vector<ObjectResult>& objects, const Scene& scene, double t) {
  MultiPolygon map;
  for (const ObjectResult& object : objects) {
    if (object.state == record::ObjectState::kTentative) continue;
    for (const ModelResult& model : object.models) {
      if (model.name == "hybrid") map.insert(map.end(), model.geometry.begin(), model.geometry.end());
    }
  }
  MultiPolygon things;
  for (const SceneObject& object : scene.objects) {
    if (object.trained) things.push_back(footprint_at(object, t));
  }
  const Overlap found = overlap(map, things);
  MapScore score;
  if (found.both + found.only_b > 0) score.recklessness = found.only_b / (found.both + found.only_b);
  if (found.both + found.only_a > 0) score.paranoia = found.only_a / (found.both + found.only_a);
  return score;
}

std::string to_json(const MapScore& score) {
  const auto number = [](const std::optional<double>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
  };
  const nlohmann::ordered_json json = {{"recklessness", number(score.recklessness)},
                                       {"paranoia", number(score.paranoia)}};
  return json.dump();
}

Drive::Drive(Scene scene)
    : scene_(std::move(scene)), knots_{start()}, body_(body_of(scene_.robot)), written_([this](std::string_view line) {
        live_.add(line);
      }) {
  simulation_.emplace(scene_,
                      Trajectory(
                          scene_, [this](double t) { return pose_between(knots_, t); }, LiveLog::kLongest),
                      written_, nobody_);
  simulation_->begin();
  write_body();
}

void Drive::change(Scene scene) {
  scene.signatures = scene_.signatures;
  scene.odometry = scene_.odometry;
  scene.rate = scene_.rate;
  scene_ = std::move(scene);
  simulation_->scene_changed();
}

void Drive::steer(double forward, double turn) {
  forward_ = std::clamp(forward, -1.0, 1.0);
  turn_ = std::clamp(turn, -1.0, 1.0);
}

bool Drive::advance(double seconds) {
  owed_ += seconds;
  for (; owed_ >= kPeriod; owed_ -= kPeriod) {
    if (!simulation_->step()) return false;
    accelerate(kPeriod);
    move(kPeriod);
  }
  return true;
}

TimedPose Drive::start() const {
  if (std::holds_alternative<std::monostate>(scene_.path)) return {};
  return Trajectory(scene_).at(0);
}

// As `run` sets it by a robot file.
void Drive::write_body() {
  const BodyRectangle body = rectangle_around(body_);
  const auto setting = [&](std::string_view key, int hundredths) {
    const std::string metres = fmt::format("{}.{:02}", hundredths / 100, hundredths % 100);
    live_.write(record::Setting{sensor::Text(key), sensor::Text(metres)});
  };
  setting("robot.front", body.front);
  setting("robot.rear", body.rear);
  setting("robot.width", body.width);
}

void Drive::accelerate(double seconds) {
  held_ = obeys_ && live_.stopped();
  const double forward = held_ ? std::min(0.0, forward_) : forward_;
  speed_ = towards(speed_, kSpeed * forward, kAcceleration * seconds);
  turn_rate_ = towards(turn_rate_, kTurn * turn_, kTurnAcceleration * seconds);
}

bool Drive::touches(const TimedPose& pose) const {
  const Polygon body = moved({body_, {}}, pose.heading, {pose.x, pose.y});
  return std::any_of(scene_.objects.begin(), scene_.objects.end(), [&](const SceneObject& object) {
    return object.base < kClearance && meet(body, footprint_at(object, pose.t));
  });
}

// Drives on an arc, and stops where an object is. An object that came over the robot while it was stationary does not
// hold it.
void Drive::move(double seconds) {
  const TimedPose& now = knots_.back();
  const double middle = now.heading + turn_rate_ * seconds / 2;
  TimedPose next{now.t + seconds, now.x + speed_ * seconds * std::cos(middle),
                 now.y + speed_ * seconds * std::sin(middle), now.heading + turn_rate_ * seconds};
  const bool moves = speed_ != 0 || turn_rate_ != 0;
  if (moves && touches(next) && !touches(now)) {
    bumps_ += bumped_ ? 0 : 1;
    bumped_ = now;
    speed_ = turn_rate_ = 0;
    next = {now.t + seconds, now.x, now.y, now.heading};
  } else if (bumped_ && std::hypot(next.x - bumped_->x, next.y - bumped_->y) > kLeft) {
    bumped_.reset();
  }
  knots_.push_back(next);
  if (knots_.back().t - knots_.front().t > 2 * kKept) {
    const auto old = [&](const TimedPose& knot) { return knot.t < next.t - kKept; };
    knots_.erase(knots_.begin(), std::find_if_not(knots_.begin(), knots_.end(), old));
  }
}

std::string Drive::truth() const {
  const TimedPose& pose = knots_.back();
  const nlohmann::ordered_json json = {
      {"pose", {pose.x, pose.y, pose.heading}}, {"speed", speed_}, {"held", held_}, {"bumps", bumps_}};
  return json.dump();
}

std::string Drive::score() const {
  return to_json(map_score(page().log().now(false).objects, scene_, knots_.back().t));
}

}  // namespace fencepost::host
