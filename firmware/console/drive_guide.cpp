#include "firmware/console/drive_guide.hpp"

#include <algorithm>

#include "firmware/console/sentence.hpp"

namespace fencepost::console {
namespace {

// A step of the way: jitter of odometry makes none.
constexpr float kStepWay = 0.02F;           // m
constexpr std::int32_t kStepTurn = 50'000;  // urad

constexpr std::int64_t kDegreesOfARadian = 57'296;  // thousandths
constexpr std::int32_t from_degrees(std::int32_t degrees) {
  return static_cast<std::int32_t>(degrees * (1'000'000'000LL / kDegreesOfARadian));
}
constexpr std::int64_t to_degrees(std::int32_t microradians) {
  return microradians * kDegreesOfARadian / 1'000'000'000LL;
}

constexpr std::uint8_t kBlocks = 3;
constexpr std::uint8_t kStraights = 4;
constexpr int kStraight = 110;                      // cm, a straight
constexpr float kApart = 0.05F;                     // focal lengths between the feet of what is near and what is far
constexpr std::int32_t kSameWay = from_degrees(9);  // still straight on
constexpr std::int32_t kAround = 360;               // degrees
constexpr std::int32_t kToOneSide = 40;             // degrees
constexpr std::uint8_t kAtASide = 20;               // frames
constexpr std::uint8_t kFeet = 200;                 // frames

std::uint8_t one_more(std::uint8_t count) { return static_cast<std::uint8_t>(count == 0xFF ? count : count + 1); }

std::size_t end_of(Sentence& s, std::int64_t count, std::int64_t of, std::string_view unit) {
  s.put(": ").number(count).put(" of ").number(of);
  return s.put(unit).end();
}

}  // namespace

bool DriveGuide::look(const recon::WaitingFrame& frame, const recon::CameraModel& camera, const recon::MapPose& pose,
                      unsigned known) {
  if (!placed_) last_ = pose;
  placed_ = true;
  known_ = static_cast<std::uint8_t>(std::min(known, 0xFFU));
  count_blobs(frame, camera);
  const float way = recon::offset_from(last_.position, pose.position).norm();
  const auto turn = static_cast<std::int32_t>(recon::short_way(std::int64_t{pose.heading} - last_.heading));
  if (way >= kStepWay || turn >= kStepTurn || turn <= -kStepTurn) {
    count_step(way, turn, !frame.blobs.empty());
    last_ = pose;
  }
  for (std::size_t i = 0; i < kDriveNeeds; ++i) {
    if (met(static_cast<DriveNeed>(i))) met_ = static_cast<std::uint8_t>(met_ | (1U << i));
  }
  return met_ != said_;
}

void DriveGuide::count_blobs(const recon::WaitingFrame& frame, const recon::CameraModel& camera) {
  bool left = false;
  bool right = false;
  float nearest = 0;  // rows of feet
  float farthest = camera.rows;
  for (const recon::WaitingBlob& blob : frame.blobs) {
    if (blob.bearing) continue;
    const recon::Sides cut = recon::cut_by_border(camera, blob.box);
    if (cut.left || cut.right) continue;
    const int twice_middle = blob.box.x1 + blob.box.x2;
    left = left || 2 * twice_middle < camera.width;
    right = right || 2 * twice_middle > 3 * camera.width;
    if (cut.bottom) continue;
    nearest = std::max(nearest, recon::bottom_edge(blob.box));
    farthest = std::min(farthest, recon::bottom_edge(blob.box));
  }
  if (nearest - farthest >= kApart * camera.fy) apart_ = true;
  if (left) left_side_ = one_more(left_side_);
  if (right) right_side_ = one_more(right_side_);
  if (nearest > 0) feet_ = one_more(feet_);
}

void DriveGuide::count_step(float way, std::int32_t turn, bool in_view) {
  // A need that is met is not counted any more, so no sum overflows.
  if (lacks(DriveNeed::kLeft) && turn > 0) left_ += turn;
  if (lacks(DriveNeed::kRight) && turn < 0) right_ -= turn;
  if (lacks(DriveNeed::kAround)) turned_ += turn;
  most_ = std::max(most_, turned_);
  least_ = std::min(least_, turned_);

  off_ += turn;
  if (off_ > kSameWay || off_ < -kSameWay) {
    off_ = 0;
    straight_ = 0;
    apart_ = false;
  }
  if (in_view) straight_ += way;
  if (straight_ < 0.01F * kStraight || !apart_) return;
  straights_ = one_more(straights_);
  straight_ = 0;
}

bool DriveGuide::met(DriveNeed need) const {
  switch (need) {
    case DriveNeed::kBlocks: return known_ >= kBlocks;
    case DriveNeed::kStraights: return straights_ >= kStraights;
    case DriveNeed::kAround: return most_ - least_ >= from_degrees(kAround);
    case DriveNeed::kLeft: return left_ >= from_degrees(kToOneSide);
    case DriveNeed::kRight: return right_ >= from_degrees(kToOneSide);
    case DriveNeed::kLeftSide: return left_side_ >= kAtASide;
    case DriveNeed::kRightSide: return right_side_ >= kAtASide;
    case DriveNeed::kFeet: return feet_ >= kFeet;
  }
  return false;
}

std::size_t DriveGuide::lines(bool logs) const {
  if (enough()) return 1;
  return 1 + (logs ? 0U : 1U) + kDriveNeeds - static_cast<std::size_t>(__builtin_popcount(met_));
}

std::size_t DriveGuide::write(std::size_t line, bool logs, std::span<char> out) const {
  Sentence s(out);
  if (enough()) return s.put("enough: end the recording and run `fencepost calibrate LOG`").end();
  if (line == 0) return s.put("the calibration drive still needs").end();
  --line;
  if (!logs) {
    if (line == 0) return s.put("  a log: nothing is counted but in `mode log`").end();
    --line;
  }
  std::size_t need = 0;
  for (;; ++need) {
    if (need == kDriveNeeds) return s.end();
    if (lacks(static_cast<DriveNeed>(need)) && line-- == 0) break;
  }
  switch (static_cast<DriveNeed>(need)) {
    case DriveNeed::kBlocks: return end_of(s.put("  blocks on the map"), known_, kBlocks, "");
    case DriveNeed::kStraights:
      s.put("  straight on for ").number(kStraight / 10, 1).put(" m, a near and a far block in view, now ");
      s.number(static_cast<std::int32_t>(100 * straight_), 2).put(" m");
      return end_of(s, straights_, kStraights, " times");
    case DriveNeed::kAround: return end_of(s.put("  all the way around"), to_degrees(most_ - least_), kAround, " deg");
    case DriveNeed::kLeft: return end_of(s.put("  turns to the left"), to_degrees(left_), kToOneSide, " deg");
    case DriveNeed::kRight: return end_of(s.put("  turns to the right"), to_degrees(right_), kToOneSide, " deg");
    case DriveNeed::kLeftSide:
      return end_of(s.put("  whole blocks in the image's left quarter"), left_side_, kAtASide, " frames");
    case DriveNeed::kRightSide:
      return end_of(s.put("  whole blocks in the image's right quarter"), right_side_, kAtASide, " frames");
    case DriveNeed::kFeet: return end_of(s.put("  whole blocks with their feet in the image"), feet_, kFeet, " frames");
  }
  return s.end();
}

}  // namespace fencepost::console
