#include "tests/studies/storm/stop_oracle.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace fencepost::test {
namespace {

constexpr base::Duration kPosesKept = base::milliseconds(2'000);
constexpr base::Duration kRemembered = base::milliseconds(1'200);
constexpr std::uint32_t kSightings = 6;  // in different frames: twice what the guard asks for
constexpr double kSamePlace = 0.04;      // m
constexpr double kInside = 0.75;         // of the stop distance, from the robot's origin
constexpr double kMiddle = 0.6;          // of half the robot's width
constexpr double kDrives = 0.05;         // m/s
constexpr double kStraight = 0.15;       // rad/s

double turn_between(const sensor::OdometrySample& from, const sensor::OdometrySample& to) {
  return std::remainder((to.heading - from.heading).to_double(), 2 * std::numbers::pi);
}

}  // namespace

void StopOracle::take(const sensor::OdometrySample& sample) {
  poses_.push_back(sample);
  while (poses_.front().t + kPosesKept < sample.t) poses_.pop_front();
  place_frames();
}

void StopOracle::take(const sensor::BlobFrame& frame, const sensor::CameraIntrinsics& camera) {
  if (!camera.mount.pitch || camera.lens != sensor::Lens::kPinhole) return;
  waiting_.push_back({frame, camera});
  place_frames();
}

void StopOracle::place_frames() {
  while (!waiting_.empty() && !poses_.empty()) {
    const base::Time exposed = waiting_.front().frame.t - waiting_.front().camera.latency;
    if (poses_.back().t < exposed) return;
    if (const auto pose = pose_at(exposed)) place(waiting_.front(), *pose);
    waiting_.pop_front();
  }
}

std::optional<sensor::OdometrySample> StopOracle::pose_at(base::Time t) const {
  for (std::size_t i = 1; i < poses_.size(); ++i) {
    const sensor::OdometrySample& before = poses_[i - 1];
    const sensor::OdometrySample& after = poses_[i];
    if (before.t > t || after.t < t || after.t - before.t > base::milliseconds(200)) continue;
    const double share = (t - before.t).to_double() / (after.t - before.t).to_double();
    sensor::OdometrySample pose = before;
    pose.x = base::Metres::nearest(before.x.to_double() + share * (after.x - before.x).to_double());
    pose.y = base::Metres::nearest(before.y.to_double() + share * (after.y - before.y).to_double());
    pose.heading = base::Radians::nearest(before.heading.to_double() + share * turn_between(before, after));
    return pose;
  }
  return std::nullopt;
}

// The middle of the foot of each blob that is seen whole, near the middle of the image, on the floor.
void StopOracle::place(const Waiting& waiting, const sensor::OdometrySample& pose) {
  const sensor::CameraIntrinsics& camera = waiting.camera;
  const double pitch = camera.mount.pitch->to_double();
  const double yaw = camera.mount.yaw.to_double();
  const double heading = pose.heading.to_double();
  for (const sensor::Blob& blob : waiting.frame.blobs) {
    if (blob.x1 <= 1 || blob.x2 >= camera.width - 2 || blob.y2 >= camera.height - 3) continue;
    const double across = -((blob.x1 + blob.x2) / 2.0 - camera.cx.to_double()) / camera.fx.to_double();
    const double down = (blob.y2 + 0.5 - camera.cy.to_double()) / camera.fy.to_double();
    const double sinking = std::sin(pitch) + down * std::cos(pitch);
    if (std::fabs(across) > 0.25 || sinking < 0.05) continue;
    const double depth = camera.mount.z.to_double() / sinking;
    const double ahead = depth * (std::cos(pitch) - down * std::sin(pitch));
    const double left = depth * across;
    if (ahead > 1.2) continue;
    const double x = camera.mount.x.to_double() + ahead * std::cos(yaw) - left * std::sin(yaw);
    const double y = camera.mount.y.to_double() + ahead * std::sin(yaw) + left * std::cos(yaw);
    seen_.push_back({waiting.frame.t, waiting.frame.frame,
                     pose.x.to_double() + x * std::cos(heading) - y * std::sin(heading),
                     pose.y.to_double() + x * std::sin(heading) + y * std::cos(heading)});
  }
}

bool StopOracle::drives_ahead() const {
  if (poses_.size() < 3) return false;
  const sensor::OdometrySample& last = poses_.back();
  for (auto first = poses_.rbegin(); first != poses_.rend(); ++first) {
    const double seconds = (last.t - first->t).to_double();
    if (seconds < 0.3) continue;
    const double heading = last.heading.to_double();
    const double ahead =
        (last.x - first->x).to_double() * std::cos(heading) + (last.y - first->y).to_double() * std::sin(heading);
    return ahead > kDrives * seconds && std::fabs(turn_between(*first, last)) < kStraight * seconds;
  }
  return false;
}

bool StopOracle::known_ahead(const config::Settings& settings, base::Time now) {
  while (!seen_.empty() && seen_.front().t + kRemembered < now) seen_.pop_front();
  if (poses_.empty() || now - poses_.back().t > base::milliseconds(150)) return false;
  const sensor::OdometrySample& here = poses_.back();
  const double near = kInside * static_cast<double>(settings.number(config::Key::kAlertStop));
  const double wide = kMiddle * static_cast<double>(settings.number(config::Key::kRobotWidth)) / 2;
  const double heading = here.heading.to_double();
  for (const Seen& place : seen_) {
    const double dx = place.x - here.x.to_double();
    const double dy = place.y - here.y.to_double();
    const double ahead = dx * std::cos(heading) + dy * std::sin(heading);
    const double left = dy * std::cos(heading) - dx * std::sin(heading);
    if (ahead <= 0.02 || std::fabs(left) > wide || std::hypot(dx, dy) > near) continue;
    std::uint32_t sightings = 0;
    std::optional<std::uint32_t> last;
    for (const Seen& other : seen_) {
      if (std::hypot(other.x - place.x, other.y - place.y) > kSamePlace || other.frame == last) continue;
      last = other.frame;
      ++sightings;
    }
    if (sightings < kSightings) continue;
    what_ = fmt::format("{:.2f} m ahead, {:.2f} m to the left, seen in {} frames within {:.1f} s", ahead, left,
                        sightings, kRemembered.to_double());
    return true;
  }
  return false;
}

base::Duration StopOracle::overdue(const config::Settings& settings, base::Time now) {
  if (!drives_ahead() || !known_ahead(settings, now)) {
    since_.reset();
    return {};
  }
  if (!since_) since_ = now;
  return now - *since_;
}

}  // namespace fencepost::test
