// The map: all objects, and what one frame does to them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "firmware/recon/digest.hpp"
#include "firmware/recon/localize/lens_check.hpp"
#include "firmware/recon/localize/pose_correction.hpp"
#include "firmware/recon/models/hybrid/outline_fitter.hpp"
#include "firmware/recon/observe/frame_queue.hpp"
#include "firmware/recon/track/object_table.hpp"
#include "firmware/recon/track/schedule.hpp"

namespace fencepost::recon {

/// No width is configured.
struct UnknownWidths {
  std::uint16_t operator()(std::uint8_t /*signature*/) const { return 0; }
};

template <class Profile>
class Map {
 public:
  using ObjectType = Object<Profile>;

  void clear() {
    table_.clear();
    pace_.clear();
    fitter_.clear();
    correction_.clear();
    guard_.clear();
    lens_check_.clear();
    standing_ = {};
    frames_ = 0;
    digest_ = base::Fnv1a64::kOffsetBasis;
  }

  /// One frame through the whole algorithm. `odometry`: where the robot was at the exposure, by odometry alone;
  /// `correction`: how far objects correct that. Blobs of `frame` that are pieces of one object are joined in place.
  /// `width_of`: how wide (mm, mean of all sides) all things of a signature are known to be; 0: not known.
  template <class WidthOf = UnknownWidths>
  FrameOutcome add_frame(WaitingFrame& frame, const CameraModel& camera, const MapPose& odometry,
                         const MeasurementNoise& noise, Confirmation confirmation,
                         const CorrectionOrder& correction = {}, const WidthOf& width_of = {}) {
    FrameOutcome outcome;
    standing_.look(odometry, frame.t - camera.latency);
    LensPose lens = lens_pose(odometry, camera);
    const LensPose by_odometry = lens;
    table_.start_frame(frame.t - camera.latency, standing_.since());
    const MapPose driven = correction_.drive(odometry, correction);
    if (driven != odometry) lens = lens_pose(driven, camera);
    const auto look = correction_.look_at(table_.exposure());
    const auto place_of = [&](const ObjectCore& object, std::size_t slot, const auto& is_alone) {
      return correction_.place_of(object, slot, look, is_alone);
    };
    matcher_.predict(table_.objects(), table_.exposure(), standing_.since(), camera, lens, noise, place_of);
    look_out(frame, camera, by_odometry, lens);
    matcher_.observe(frame, camera, table_.objects());
    matcher_.tell_widths(width_of);
    outcome.matched = matcher_.match(table_.ids().cost());
    const MapPose pose = correction_.correct(driven, table_.objects(), matcher_, camera, noise);
    if (pose != driven) lens = lens_pose(pose, camera);
    table_.update(matcher_, camera, lens, outcome);
    const bool due = pace_.due(table_.exposure(), Profile::kModelInterval);
    if (due) update_models(table_, matcher_, camera, lens, correction_.model_noise(noise));
    fitter_.fit(table_, due);
    table_.tidy(matcher_, confirmation);
    correction_.follow(table_, matcher_, camera, noise);
    lens_check_.look(table_, matcher_, camera, lens, odometry);
    chain_digest(frame, pose);
    return outcome;
  }

  /// The stream has ended: outlines know all that was seen. The digest is that of the last frame.
  void finish() { fitter_.finish(table_); }

  /// The calibration has changed: clears everything that was learned with the old one about the camera and the floor.
  void recalibrated() {
    guard_.clear();
    lens_check_.clear();
    table_.recalibrated();
  }
  /// True if the robot is stationary, by the latest frame.
  [[nodiscard]] bool stands() const { return standing_.stands(); }
  /// Beside the objects: where the feet of blobs were seen, in the frame of odometry alone.
  [[nodiscard]] const guard::Guard<Profile::kFronts>& guard() const { return guard_; }

  /// The check of the configured focal length.
  [[nodiscard]] const LensCheck& lens_check() const { return lens_check_; }

  /// The robot's pose in the map, by odometry and all corrections so far.
  [[nodiscard]] MapPose corrected(const MapPose& odometry) const { return correction_.corrected(odometry); }
  [[nodiscard]] const PoseCorrection<Profile>& correction() const { return correction_; }

  /// Some object is known by bearings alone: they place its middle, whatever its width.
  [[nodiscard]] bool knows_bearings() const {
    const auto by_bearings = [](const ObjectType& object) { return object.used() && object.cylinder.only_bearings(); };
    return std::any_of(slots_in_use().begin(), slots_in_use().end(), by_bearings);
  }

  [[nodiscard]] std::span<const ObjectType> slots() const { return table_.objects(); }
  /// The slots up to the last object of the last frame: those behind it are free.
  [[nodiscard]] std::span<const ObjectType> slots_in_use() const { return slots().first(matcher_.slots()); }
  [[nodiscard]] std::uint64_t digest() const { return digest_; }
  [[nodiscard]] std::uint32_t frames() const { return frames_; }
  [[nodiscard]] std::uint32_t evicted() const { return table_.evicted(); }
  [[nodiscard]] std::uint32_t size() const { return table_.size(); }
  /// The objects' events of the last frame, in order.
  [[nodiscard]] std::span<const ObjectEvent> events() const { return table_.events(); }
  /// True if the object in this slot was seen in the last frame.
  [[nodiscard]] bool seen_now(std::size_t slot) const { return matcher_.seen(slot); }
  /// The blob that the object in this slot took in the last frame (its order in the WaitingFrame), or kNoMatch.
  [[nodiscard]] std::uint8_t blob_of(std::size_t slot) const { return matcher_.blob_of(slot); }

 private:
  // `lens`: by the map, which tells the guard how wide the feet of the things can be that it knows.
  [[gnu::noinline]] void look_out(const WaitingFrame& frame, const CameraModel& camera, const LensPose& by_odometry,
                                  const LensPose& lens) {
    guard::KnownFeet feet;
    if (camera.floor.usable()) add_feet(lens, feet);
    guard_.look(frame, camera, by_odometry, standing_.since(), feet);
  }
  // Returns before the guard looks, which needs the stack.
  [[gnu::noinline]] void add_feet(const LensPose& lens, guard::KnownFeet& feet) const {
    constexpr float kReach = 0.001F * guard::kForgotten;
    for (std::size_t o = 0; o < matcher_.slots(); ++o) {
      const ObjectType& object = slots()[o];
      const float depth = matcher_.prediction(o).depth;  // 0: it has no place
      if (!(depth > 0 && depth < kReach) || !object.confirmed || object.moving) continue;
      const CylinderEstimate& cylinder = object.cylinder.estimate();
      if (!cylinder.ok()) continue;
      if (object.cylinder.known_whole()) {
        const float along = cylinder.radius + kUsualSigmas * cylinder.outline_sigma();
        add_foot({along, cylinder.radius, along, cylinder.radius}, cylinder.center - lens.lens_from(object.origin),
                 lens, object.signature, feet);
      } else if (const PlacedOutline outline = object.placed_outline(); outline.known) {
        add_foot(reaches_of(outline.view, lens.axis), -lens.lens_from(outline.origin), lens, object.signature, feet);
      }
    }
  }

  // m, how far a thing reaches ahead, to the left, back and to the right of `from_lens` (map axes).
  using Reaches = std::array<float, 4>;
  static void add_foot(const Reaches& reaches, const Vec2& from_lens, const LensPose& lens, std::uint8_t signature,
                       guard::KnownFeet& feet) {
    const auto millimetres = [](float metres) {
      return static_cast<std::int16_t>(nearest_whole(kMillimetresPerMetre * metres, INT16_MAX));
    };
    const Vec2 at = to_camera(lens, from_lens);
    static_cast<void>(feet.push_back({millimetres(at.x() - reaches[2]), millimetres(at.x() + reaches[0]),
                                      millimetres(at.y() + reaches[1]), millimetres(at.y() - reaches[3]), signature}));
  }
  // One sigma more than the outline itself.
  static Reaches reaches_of(const OutlineView& outline, const Vec2& axis) {
    const std::size_t sides = outline.offsets.size();
    const SectorPlace ahead = place_of(axis, sides);
    Reaches reaches;
    for (std::size_t quarter = 0; quarter < reaches.size(); ++quarter) {
      const std::size_t k = (ahead.sector + quarter * sides / reaches.size()) % sides;
      const std::size_t next = (k + 1) % sides;
      reaches[quarter] = outline.offset(k) + ahead.phase * (outline.offset(next) - outline.offset(k)) +
                         std::max(outline.sigma(k), outline.sigma(next));
    }
    return reaches;
  }

  [[gnu::noinline]] void chain_digest(const WaitingFrame& frame, const MapPose& pose) {
    constexpr std::size_t kObjects = Profile::kObjects;
    base::Fnv1a64 hash;
    hash.i64(static_cast<std::int64_t>(digest_));
    hash.u32(frame.frame);
    hash.i64(table_.exposure().raw);
    hash_pose(hash, pose);
    hash.u32(table_.size());
    hash.u32(table_.next_id());
    for (std::size_t o = 0; o < matcher_.slots(); ++o) {
      if (slots()[o].used() && matcher_.seen(o)) hash_sighted(hash, slots()[o]);
    }
    const ObjectType& turn = slots()[frames_ % kObjects];
    if (turn.used()) turn.hash_part(hash, frames_ / kObjects % ObjectType::kHashParts);
    table_.ids().hash(hash);
    hash_standing(hash, standing_);
    hash_guard(hash, guard_, frames_);
    lens_check_.hash(hash, frames_);
    if (correction_.looks()) hash_correction(hash, correction_, correction_.looks_taken() % kObjects);
    ++frames_;
    digest_ = hash.value();
  }

  ObjectTable<Profile> table_;
  ModelPace pace_;
  Matcher<ObjectType, Profile::kObjects> matcher_;
  OutlineFitter<Profile> fitter_;
  PoseCorrection<Profile> correction_;
  guard::Guard<Profile::kFronts> guard_;
  LensCheck lens_check_;
  Standing standing_;
  std::uint32_t frames_ = 0;
  std::uint64_t digest_ = base::Fnv1a64::kOffsetBasis;
};

}  // namespace fencepost::recon
