#include "firmware/alert/sight.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/alert/tuning.hpp"

namespace fencepost::alert {
namespace {

constexpr std::int64_t kTicksPerMs = base::Duration::kPerUnit / 1000;
constexpr std::uint32_t kSlowImageTicks = base::milliseconds(2).raw;
static_assert(kSlowestImage.raw / kSlowImageTicks <= 255 && kSlowImageTicks % 4 == 0);

// FNV-1a, of whole values: with a small factor, two edges that move together could cancel. 0: no boxes.
std::uint32_t hash_of(const recon::WaitingFrame& frame) {
  if (frame.blobs.empty()) return 0;
  std::uint32_t hash = 0x811C9DC5;
  const auto add = [&hash](std::int32_t value) { hash = (hash ^ static_cast<std::uint32_t>(value)) * 0x01000193; };
  for (const recon::WaitingBlob& blob : frame.blobs.view()) {
    add(blob.signature);
    for (const std::int16_t edge : {blob.box.x1, blob.box.y1, blob.box.x2, blob.box.y2}) add(edge);
  }
  return std::max<std::uint32_t>(hash, 1);
}

// m and rad, both without a sign.
struct Displacement {
  float moved = 0;
  float turned = 0;
};

Displacement displacement_between(const recon::MapPose& from, const recon::MapPose& to) {
  const std::int64_t turn = recon::short_way(std::int64_t{to.heading} - from.heading);
  return {recon::offset_from(from.position, to.position).norm(), std::fabs(1e-6F * static_cast<float>(turn))};
}

// So short a step that it is no jump, however soon after the last one. In whole numbers, for most steps are.
bool surely_no_jump(const recon::MapPose& from, const recon::MapPose& to) {
  constexpr auto kStep = static_cast<std::int32_t>(0.5F * kStepJump * static_cast<float>(recon::kMapUnitsPerMetre));
  constexpr auto kTurn = static_cast<std::int32_t>(0.5F * kTurnJump * 1e6F);
  const auto within = [](std::int32_t a, std::int32_t b, std::int32_t most) {
    const std::int64_t step = std::int64_t{b} - a;
    return step < most && step > -most;
  };
  return within(from.position.x, to.position.x, kStep) && within(from.position.y, to.position.y, kStep) &&
         within(from.heading, to.heading, kTurn);
}

// Expected motion of the boxes, px, if the camera is live: the sum over all edges inside the image. Each pixel of it
// would change the frame.
float expected_shift(const recon::WaitingFrame& frame, const recon::CameraModel& camera, const Displacement& by) {
  float shift = 0;
  for (const recon::WaitingBlob& blob : frame.blobs.view()) {
    const recon::Sides cut = recon::cut_by_border(camera, blob.box);
    const int sides = (cut.left ? 0 : 1) + (cut.right ? 0 : 1);
    shift += static_cast<float>(sides) * by.turned * camera.fx;
    if (blob.bearing || cut.bottom || !camera.pitch_known || !(camera.height > 0)) continue;
    const float drop = recon::drop_per_depth(camera, camera.cx, recon::bottom_edge(blob.box));
    if (drop > 0) shift += by.moved * camera.fy * drop * drop / camera.height;
  }
  return shift;
}

}  // namespace

void Rhythm::beat(base::Time t) {
  if (begun_) {
    constexpr auto kTicks = static_cast<std::int32_t>(kTicksPerMs);  // small cores divide 32 bits
    const auto ticks = static_cast<std::int32_t>(std::clamp<std::int64_t>(last_.since(t).raw, 0, kMaxOverdue.raw));
    const std::int32_t passed = ticks / kTicks;
    interval_ = static_cast<std::uint16_t>(interval_ == 0 ? passed : interval_ + (passed - interval_) / 8);
  }
  begun_ = true;
  last_ = base::Stamp(t);
}

bool Rhythm::overdue(base::Time now, bool standing) const {
  const base::Duration usual{interval_ * kTicksPerMs * kOverdueQuarters / 4};
  const base::Duration least = standing ? kOverdueStanding : kMinOverdue;
  return begun_ && last_.since(now) > std::clamp(usual, least, kMaxOverdue);
}

void Sight::start(base::Time t) {
  started_ = true;
  started_at_ = base::Stamp(t);
}

void Sight::odometry_came(const sensor::OdometrySample& sample) {
  const recon::MapPose pose = recon::to_map_pose(sample);
  const base::Duration since = odometry_.begun() ? odometry_.since_last(sample.t) : base::Duration{};
  if (odometry_.begun() && (since.raw < 0 || !surely_no_jump(told_, pose))) {
    const float seconds = static_cast<float>(since.raw) / static_cast<float>(base::Duration::kPerUnit);
    const Displacement step = displacement_between(told_, pose);
    if (step.moved > kStepJump + kFastest * seconds || step.turned > kTurnJump + kFastestTurn * seconds) {
      jumped_ = true;
      jumped_at_ = base::Stamp(sample.t);
    }
  }
  odometry_.beat(sample.t);
  told_ = pose;
}

void Sight::frame_came(base::Time t) { frames_.beat(t); }

void Sight::frame_used(const recon::WaitingFrame& frame, const recon::CameraModel& camera,
                       const recon::MapPose& odometry) {
  used_.beat(frame.t);
  const std::uint32_t boxes = hash_of(frame);
  if (boxes != 0) blobs_at_ = base::Stamp(frame.t);
  if (boxes != boxes_ || boxes == 0) {
    if (boxes_ != 0) image_changed(frame.t);
    boxes_ = boxes;
    same_since_ = base::Stamp(frame.t);
    same_from_ = odometry;
    image_ = Image::kChanges;
    return;
  }
  const base::Duration same = same_since_.since(frame.t);
  if (image_ == Image::kFrozen || same < kFrozenFor) return;
  if (expected_shift(frame, camera, displacement_between(same_from_, odometry)) < kFrozenShift) return;
  image_ = same < image_patience() ? Image::kLate : Image::kFrozen;
}

// One that comes soon shows that the camera is not slow; one that is late, though nothing moved, shows nothing.
void Sight::image_changed(base::Time t) {
  const base::Duration took = same_since_.since(t);
  if (took < kFrozenFor) slow_image_ = 0;
  if (image_ == Image::kChanges || took > kSlowestImage) return;
  slow_image_ = static_cast<std::uint8_t>(static_cast<std::uint32_t>(took.raw) / kSlowImageTicks);
}

base::Duration Sight::image_patience() const {
  const base::Duration slow{slow_image_ * (kSlowImageTicks * 5 / 4)};
  return std::max(kFrozenFor, slow);
}

bool Sight::jumped_lately(base::Time now) const { return jumped_ && jumped_at_.since(now) < recon::kMoment; }

Blindness Sight::blindness(base::Time now, bool standing) const {
  const base::Duration grace = standing ? kOverdueStanding : kMinOverdue;
  const bool begins = !started_ || started_at_.since(now) <= grace;
  if (!begins && !frames_.begun()) return Blindness::kNoCamera;
  if (!begins && !odometry_.begun()) return Blindness::kNoOdometry;
  if (frames_.overdue(now, standing)) return Blindness::kCameraLate;
  if (odometry_.overdue(now, standing)) return Blindness::kOdometryLate;
  if (jumped_lately(now)) return Blindness::kJump;
  if (used_.overdue(now, standing) || (!begins && !used_.begun())) return Blindness::kFramesUnused;
  return image_ == Image::kFrozen ? Blindness::kFrozen : Blindness::kNone;
}

sensor::LinkState Sight::camera_state(base::Time now, bool standing) const {
  if (!frames_.begun()) return sensor::LinkState::kAbsent;
  if (frames_.overdue(now, standing)) return sensor::LinkState::kSilent;
  if (!used_.begun() || used_.overdue(now, standing) || image_ == Image::kFrozen) {
    return sensor::LinkState::kUnready;
  }
  return boxes_ == 0 && blobs_at_.since(now) >= kEmptyAfter ? sensor::LinkState::kEmpty : sensor::LinkState::kOk;
}

sensor::LinkState Sight::odometry_state(base::Time now, bool standing) const {
  if (!odometry_.begun()) return sensor::LinkState::kAbsent;
  if (odometry_.overdue(now, standing)) return sensor::LinkState::kSilent;
  return jumped_lately(now) ? sensor::LinkState::kUnready : sensor::LinkState::kOk;
}

}  // namespace fencepost::alert
