// One object: what it is, how often it was seen, and its models. Each sighting passes through track(); the models take
// those for which the map has a turn, by model().
#pragma once

#include <algorithm>
#include <cstdint>

#include "firmware/recon/models/cylinder.hpp"
#include "firmware/recon/models/height_band.hpp"
#include "firmware/recon/models/hybrid/hybrid.hpp"
#include "firmware/recon/models/model_list.hpp"
#include "firmware/recon/models/model_view.hpp"
#include "firmware/recon/track/tuning.hpp"
#include "hal/base/units.hpp"

namespace fencepost::recon {

/// The last frames in which the object could be seen, newest in bit 0: 1 = it was.
struct SightingHistory {
  std::uint16_t bits = 0;
  std::uint8_t length = 0;

  void push(bool seen) {
    bits = static_cast<std::uint16_t>((static_cast<unsigned>(bits) << 1U) | (seen ? 1U : 0U));
    if (length < 16) ++length;
  }
  /// Sightings among the last `n` (at most 16).
  [[nodiscard]] int seen_of_last(int n) const {
    const unsigned mask = n >= 16 ? 0xFFFFU : (1U << static_cast<unsigned>(n)) - 1U;
    return __builtin_popcount(bits & mask);
  }
};

/// The part of an object that does not depend on the profile.
struct ObjectCore {
  std::uint32_t id = 0;  ///< 0: free slot
  std::uint8_t signature = 0;
  bool confirmed = false;
  bool clear = false;     ///< the last sighting was large enough that the same view must show it again
  bool moving = false;    ///< by itself, when it was seen last: its models know that sighting alone
  End left = End::kSeen;  ///< of the last sighting
  End right = End::kSeen;
  std::uint8_t relocations = 0;  ///< of the local frame; 0: its place is a guess
  std::uint8_t in_pieces = 0;    ///< frames in a row in which it was two blobs with nothing between them
  std::int8_t left_off = 0;  ///< frames in a row in which its left end was far off to one side; negative: to the left
  std::int8_t right_off = 0;
  std::int16_t foot_row = 0;    ///< of the last sighting whose foot was not elsewhere although the robot was stationary
  std::uint8_t last_track = 0;  ///< id of the last sighting by a camera that tracks; 0: none, or too long ago
  std::uint32_t views = 0;
  base::Time last_seen;
  SightingHistory history;
  std::uint16_t missed_for = 0;  ///< ticks of 0.1 ms in which it should have been seen and was not, see weigh()
  std::uint8_t waiting = 0;      ///< sightings since the last one that the models took; a new object's count more
  std::uint8_t outline_confidence = kNoOutline;  ///< quantised, of the hybrid's outline; kNoOutline: there is none yet
  float presence = 1;                            ///< running share of expected sightings that came
  MapPoint origin;                               ///< of the local frame of all models
  Vec2 last_lens{0, 0};                          ///< of the last sighting that the models took; local
  Vec2 last_bearing{1, 0};                       ///< of the same; unit, map axes
  Cylinder cylinder;
  HeightBand band;

  static constexpr std::uint8_t kNoOutline = 0xFF;
  static constexpr float kConfidenceSteps = 200.0F;  ///< of outline_confidence, from 0 to 1

  [[nodiscard]] bool used() const { return id != 0; }
  [[nodiscard]] bool placed() const { return relocations > 0; }
  /// It should have been seen again and again and was not: it is not there, or not where it was.
  [[nodiscard]] bool refuted() const { return missed_for >= kMoment.raw; }
  /// It moves, or its rows allow that: it ends once it is out of the image.
  [[nodiscard]] bool may_move() const { return moving || cylinder.rows_beyond_edges(); }
  /// An end of it was outside the image or hidden when it was seen last.
  [[nodiscard]] bool cut_off() const { return !is_edge(left) || !is_edge(right); }
  /// Sighting after sighting one end is off and the other is not: the models are of something else. Both off to one
  /// side is a wrong pose.
  [[nodiscard]] bool contradicted() const {
    return left_off * right_off <= 0 && std::max(std::abs(left_off), std::abs(right_off)) >= kContradictingFrames;
  }

  /// Evidence of one frame for its existence. A sighting counts twice what a missing one does: cameras miss. The bound
  /// lets a thing that is back be believed after a quarter of a second.
  void weigh(bool seen, base::Duration elapsed) {
    const std::int64_t missed = missed_for + (seen ? -2 : 1) * elapsed.raw;
    missed_for = static_cast<std::uint16_t>(std::clamp<std::int64_t>(missed, 0, 2 * kMoment.raw));
  }

  /// Updates what matching, alerts and the table's order need of every sighting.
  void track(End left_end, End right_end, base::Time t) {
    left = left_end;
    right = right_end;
    last_seen = t;
    ++views;
    if (waiting < 0xFF) ++waiting;
  }

  /// In [0, 1]: how well the outline is known, 1 - sqrt(mean sigma / radius), times the share of expected sightings
  /// that came. The outline is the hybrid's; the cylinder's until that has been fitted; without either 0.
  [[nodiscard]] float confidence() const;
  /// Weight of a view from `lens`, in [0.05, 1]: a stationary robot sees nothing new.
  [[nodiscard]] float novelty(const Vec2& lens) const;
  void hash(base::Fnv1a64& hash) const;
};

/// True if the centre of one lies in the other's cylinder. Both estimates must be there.
bool stand_in_one_place(const ObjectCore& a, const ObjectCore& b);

template <class Profile>
struct Object : ObjectCore {
  static constexpr bool kPredictsByOutline = Profile::kPredictsByOutline;
  using HybridType = Hybrid<Profile::kHybridSectors>;

  typename Profile::Models models;
  /// Of the desk: more models of the same sightings, no part of the robot's state. Empty on a robot.
  [[no_unique_address]] typename Profile::ComparisonModels comparison;

  [[nodiscard]] HybridType& hybrid() { return models.template get<HybridType>(); }
  [[nodiscard]] const HybridType& hybrid() const { return models.template get<HybridType>(); }

  /// Starts a new object at its first sighting, which is still to be tracked.
  void begin(std::uint32_t new_id, std::uint8_t new_signature, const Sighting& first, base::Time t) {
    static_cast<ObjectCore&>(*this) = ObjectCore{};  // member by member: a whole object does not fit on the stack
    id = new_id;
    signature = new_signature;
    last_seen = t;
    waiting = 2 * Profile::kObjects;  // no alert before it has a place: it goes before all that had a turn lately
    last_lens = first.lens_from(first.anchor);
    origin = moved(first.anchor, last_lens + prior_distance(first) * first.center);
    last_lens = first.lens_from(origin);
    last_bearing = first.center;
    for_each_model([&](auto& model) { model.start(first, origin); });
  }

  /// The models were of something else: starts them again with this sighting. Identity, history, confirmation and
  /// presence stay.
  void restart(const Sighting& sighting, base::Time t) {
    const SightingHistory seen = history;
    const bool was_confirmed = confirmed;
    const float was_present = presence;
    begin(id, signature, sighting, t);
    history = seen;
    confirmed = was_confirmed;
    presence = was_present;
  }

  /// Moves the object by `step` (m): it was seen from poses that were wrong by as much.
  void shift(const Vec2& step) {
    origin = moved(origin, step);
    for_each_model([&](auto& model) { model.shift(step); });
  }

  /// The outline has been fitted.
  void note_outline() {
    if (!hybrid().ok()) return;
    outline_confidence = static_cast<std::uint8_t>(hybrid().outline().confidence() * kConfidenceSteps + 0.5F);
  }

  [[nodiscard]] PlacedOutline placed_outline() const {
    // OutlineView::known_well() by the confidence that is kept: sigmas are not summed again in each frame.
    constexpr std::uint8_t kMinConfidence = 74;

    constexpr float kRoot = 1.0F - kMinConfidence / kConfidenceSteps;
    static_assert(kRoot * kRoot < kWellKnownShare && kRoot * kRoot > 0.99F * kWellKnownShare);
    return {hybrid().outline(), hybrid().origin,
            outline_confidence != kNoOutline && outline_confidence >= kMinConfidence};
  }

  /// Adds a sighting to the models. A view's weight is how far the lens has moved since the last one that was added. At
  /// tens of frames a second, views in between would repeat it.
  [[gnu::noinline]] void model(const Sighting& sighting, const MeasurementNoise& noise) {
    const Vec2 lens = sighting.lens_from(origin);
    const float weight = cylinder.first_views() == 0 ? 1.0F : novelty(lens);
    cylinder.add(sighting, origin, weight, noise);
    cylinder.solve(lens, sighting.center, noise);
    band.add(sighting, origin);
    last_lens = lens;
    last_bearing = sighting.center;
    waiting = 0;
    if (cylinder.estimate().ok() && must_relocate()) relocate();
    Sighting believed = sighting;
    believed.lens_height *= cylinder.row_trend().nearer();
    for_each_model([&](auto& model) { model.add({believed, origin, weight, noise}); });
  }

  /// Parts of the state of which a frame hashes one: the core, then those of the models.
  static constexpr std::size_t kHashParts = 1 + Profile::Models::kHashParts;
  void hash_part(base::Fnv1a64& hash, std::size_t part) const {
    if (part == 0) {
      ObjectCore::hash(hash);
    } else {
      models.hash(hash, part - 1);
    }
  }

 private:
  template <class Visit>
  void for_each_model(Visit&& visit) {
    models.for_each(visit);
    comparison.for_each(visit);
  }

  // The estimate has left the inner part of the square in which the models live.
  [[nodiscard]] bool must_relocate() const {
    constexpr float kInner = 0.75F * kArenaHalfSide;
    return !placed() || cylinder.estimate().center.squared_norm() > kInner * kInner;
  }

  // Puts the local origin at the estimate.
  void relocate() {
    const MapPoint target = moved(origin, cylinder.estimate().center);
    const Vec2 shift = offset_from(origin, target);
    origin = target;
    last_lens -= shift;
    cylinder.move_origin(shift);
    band.move_origin(shift);
    for_each_model([&](auto& model) { model.move_origin(shift); });
    if (relocations < 0xFF) ++relocations;
  }
};

}  // namespace fencepost::recon
