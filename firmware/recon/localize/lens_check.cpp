#include "firmware/recon/localize/lens_check.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/recon/localize/tuning.hpp"
#include "firmware/recon/models/hash.hpp"
#include "hal/base/trig.hpp"

namespace fencepost::recon {
namespace {

std::int32_t turn_between(std::int32_t from, std::int32_t to) {
  return static_cast<std::int32_t>(short_way(std::int64_t{to} - from));
}

}  // namespace

float LensCheck::configured_over_true() const {
  return turned_configured_ > 0 ? turned_square_ / turned_configured_ : 1.0F;
}

// True if the robot turns, by the heading of the frame before.
bool LensCheck::turn(std::int32_t heading, base::Time exposure) {
  const std::int32_t step = turn_between(heading_, heading);
  const base::Duration passed = exposure_.since(exposure);
  heading_ = heading;
  exposure_ = base::Stamp(exposure);
  if (passed.raw <= 0 || passed > kMoment) return false;
  const auto ticks = static_cast<std::int32_t>(passed.raw);
  const std::int32_t least = kLensMinRate * ticks;
  if (step < least && step > -least) return false;
  rate_now_ = 0.01F * static_cast<float>(step) / static_cast<float>(ticks);
  return true;
}

bool LensCheck::turned_on(std::int32_t heading) const {
  const std::int32_t turned = turn_between(then_.heading, heading);
  return turned >= kLensTurn || turned <= -kLensTurn;
}

void LensCheck::take(const ObjectCore& object, const Observation& seen, const CameraModel& camera, const LensPose& lens,
                     const MapPose& odometry, bool begins) {
  const float u = 0.5F * (left_edge(seen.box) + right_edge(seen.box));
  const float v = 0.5F * (top_edge(seen.box) + bottom_edge(seen.box));
  const Vec2 away = object.cylinder.estimate().center - lens.lens_from(object.origin);
  const View view{ground_direction(camera, u, v), away.norm()};
  if (begins) {
    fresh_ = true;
  } else {
    compare(view, camera, odometry);
  }
  then_ = odometry;
  view_ = view;
  rate_ = rate_now_;
}

void LensCheck::compare(const View& view, const CameraModel& camera, const MapPose& odometry) {
  const LensPose then = lens_pose(then_, camera);
  const LensPose now = lens_pose(odometry, camera);
  const Vec2 way = to_camera(then, offset_from(then.anchor, now.anchor) + now.lens - then.lens);
  const Vec2 away = view_.distance * view_.bearing - way;
  const float ahead = view_.bearing.dot(away);
  if (view_.distance < kLensNearest || !(ahead > 0)) return;
  const float heading = 1e-6F * static_cast<float>(turn_between(then_.heading, odometry.heading));
  const float parallax = cross(view_.bearing, away) / ahead;
  const float turned = heading - parallax;
  const bool steady = std::fabs(rate_now_ - rate_) <= kLensSteady * std::fabs(turned);
  if (!steady || std::fabs(parallax) > kLensMaxParallax * std::fabs(heading)) return;
  learn(turned, base::atan2_rad(cross(view.bearing, view_.bearing), view.bearing.dot(view_.bearing)));
}

void LensCheck::learn(float turned, float configured) {
  const float product = turned * configured;
  const float square = turned * turned;
  if (product * kLensMaxOff < square || product > kLensMaxOff * square) return;
  turned_square_ += square;
  turned_configured_ += product;
  configured_square_ += configured * configured;
  ++samples_;
  if (fresh_ && objects_ < kLensObjects) ++objects_;
  fresh_ = false;
  judge();
  if (samples_ < kLensMaxSamples) return;
  samples_ /= 2;
  turned_square_ *= 0.5F;
  turned_configured_ *= 0.5F;
  configured_square_ *= 0.5F;
}

void LensCheck::judge() {
  if (samples_ < kLensMinSamples || objects_ < kLensObjects) return;
  const LensGate& gate = wrong_ ? kLensRight : kLensWrong;
  const float share =
      turned_configured_ / turned_square_;  // apparent turn over the robot's turn: true over configured focal length
  const float scatter = (configured_square_ - share * turned_configured_) / static_cast<float>(samples_ - 1);
  const float variance = std::max(scatter, kLensSampleSigma * kLensSampleSigma);
  const float off = share - 1;
  const bool sure = off * off * turned_square_ > gate.sigmas * gate.sigmas * variance;
  wrong_ = sure && (share > gate.factor || share * gate.factor < 1);
}

void LensCheck::hash(base::Fnv1a64& hash, std::uint32_t turn) const {
  switch (turn % 4) {
    case 0:
      for (const float sum : {turned_square_, turned_configured_, configured_square_}) hash.f32(sum);
      break;
    case 1:
      for (const std::int32_t count : {then_.position.x, then_.position.y, then_.heading}) hash.i32(count);
      break;
    case 2:
      hash_vec(hash, view_.bearing);
      hash.f32(view_.distance);
      break;
    default:
      hash.f32(rate_);
      hash.u32(id_);
      for (const std::uint8_t count : {slot_, samples_, objects_}) hash.u8(count);
      hash.u8(fresh_ ? 1 : 0);
      hash.u8(wrong_ ? 1 : 0);
      break;
  }
}

}  // namespace fencepost::recon
