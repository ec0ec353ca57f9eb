// One object: what it is, how often it was seen, and its models. Each sighting passes through track(); the models take
// those for which the map has a turn, by model().
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <type_traits>

#include "firmware/recon/models/carve.hpp"
#include "firmware/recon/models/clip.hpp"
#include "firmware/recon/models/cylinder.hpp"
#include "firmware/recon/models/cylinder_paper.hpp"
#include "firmware/recon/models/height_band.hpp"
#include "firmware/recon/models/hybrid/hybrid.hpp"
#include "firmware/recon/models/sheaf.hpp"
#include "firmware/recon/observe/sighting.hpp"
#include "hal/base/fixed.hpp"
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

/// What does not depend on the profile.
struct ObjectCore {
  std::uint32_t id = 0;  ///< 0: free slot
  std::uint8_t signature = 0;
  bool confirmed = false;
  bool left_open = false;  ///< the left end of the last sighting was censored: the object goes on there
  bool right_open = false;
  std::uint8_t arenas = 0;     ///< how often the models were given a place; 0: theirs is a guess
  std::uint8_t in_pieces = 0;  ///< frames in a row in which it was two blobs with nothing between them
  std::int8_t left_off = 0;    ///< frames in a row in which its left end was far off to one side; negative: to the left
  std::int8_t right_off = 0;
  std::uint32_t views = 0;
  base::Time last_seen;
  SightingHistory history;
  std::uint16_t missed_in_a_row = 0;  ///< frames in which it should have been seen and was not, since the last sighting
  std::uint8_t waiting = 0;           ///< sightings since the last one that the models took; a new object's count more
  std::uint8_t sureness = kNoOutline;  ///< of the hybrid's outline, in half per cent; kNoOutline: there is none yet
  float presence = 1;                  ///< running share of expected sightings that came
  MapPoint origin;                     ///< of the local frame of all models
  Vec2 last_lens{0, 0};                ///< of the last sighting that the models took; local
  Vec2 last_bearing{1, 0};             ///< of the same; unit, map axes
  Cylinder cylinder;
  HeightBand band;

  static constexpr std::uint8_t kNoOutline = 0xFF;
  static constexpr float kSurenessPerUnit = 200.0F;

  [[nodiscard]] bool used() const { return id != 0; }
  [[nodiscard]] bool placed() const { return arenas > 0; }
  /// Sighting after sighting one end is off and the other is not: the models are of something else. Both off to one
  /// side is a wrong pose.
  [[nodiscard]] bool contradicted() const {
    constexpr int kEnough = 10;  // a lost or grown segment says it once
    return left_off * right_off <= 0 && std::max(std::abs(left_off), std::abs(right_off)) >= kEnough;
  }

  /// What matching, alerts and the table's order need of every sighting.
  void track(const OpenEnds& ends, base::Time t) {
    left_open = ends.left;
    right_open = ends.right;
    last_seen = t;
    missed_in_a_row = 0;
    ++views;
    if (waiting < 0xFF) ++waiting;
  }

  /// In [0, 1]: how well the outline is known, 1 - sqrt(mean sigma / radius), times the share of expected sightings
  /// that came. The outline is the hybrid's; the cylinder's until that has been fitted; without either 0.
  [[nodiscard]] float confidence() const;
  /// Weight of a view from `lens`: what a parked robot sees again is not news. In [0.05, 1].
  [[nodiscard]] float novelty(const Vec2& lens) const;
};

/// True if the centre of one lies in the other's cylinder. Both estimates must be there.
bool stand_in_one_place(const ObjectCore& a, const ObjectCore& b);

/// The bounded number of times that models may start again elsewhere because their first place was wrong.
inline constexpr std::uint8_t kMaxArenas = 4;

template <class Profile>
struct Object : ObjectCore {
  static constexpr bool kPredictsByOutline = Profile::kPredictsByOutline;

  base::FixedVector<HalfPlane, Profile::kPending> pending;  ///< tangents seen while the place was a guess
  ConvexClip<Profile::kClipVertices> clip;
  [[no_unique_address]] CarveGrid<Profile::kGridCells> grid;
  [[no_unique_address]] std::conditional_t<Profile::kPaperCylinder, CylinderPaper, NoCylinderPaper> cylinder_paper;
  [[no_unique_address]] SheafViews<Profile::kSheafViews> sheaf;
  Hybrid<Profile::kHybridSectors> hybrid;

  /// Starts a new object at its first sighting, which is still to be tracked.
  void begin(std::uint32_t new_id, std::uint8_t new_signature, const Sighting& first, base::Time t) {
    static_cast<ObjectCore&>(*this) = ObjectCore{};  // member by member: a whole object does not fit on the stack
    pending.clear();
    cylinder_paper = {};
    sheaf.clear();
    hybrid.begin(first);
    id = new_id;
    signature = new_signature;
    last_seen = t;
    waiting = Profile::kObjects;  // no alert before it has a place: it goes before all that had a turn lately
    last_lens = first.lens_from(first.anchor);
    origin = moved(first.anchor, last_lens + prior_distance(first) * first.center);
    last_lens = first.lens_from(origin);
    last_bearing = first.center;
    // A guessed place, until there is an estimate: what the first wedges leave is known before any distance is.
    clip.start();
    grid.start();
  }

  /// The models were of something else: starts them again with this sighting; who it is and that it is there stays.
  void restart(const Sighting& sighting, base::Time t) {
    const SightingHistory seen = history;
    const bool was_confirmed = confirmed;
    const float was_present = presence;
    begin(id, signature, sighting, t);
    history = seen;
    confirmed = was_confirmed;
    presence = was_present;
  }

  /// The object stands elsewhere by `step` (m): it was seen from poses that were wrong by as much.
  void shift(const Vec2& step) {
    origin = moved(origin, step);
    hybrid.origin = moved(hybrid.origin, step);
  }

  /// The outline has been fitted.
  void note_outline() {
    if (hybrid.ok()) sureness = static_cast<std::uint8_t>(hybrid.outline().confidence() * kSurenessPerUnit + 0.5F);
  }

  [[nodiscard]] PlacedOutline placed_outline() const {
    // OutlineView::known_well() by the confidence that is kept: sigmas are not summed again in each frame.
    constexpr std::uint8_t kLeastSureness = 74;
    constexpr float kRoot = 1.0F - kLeastSureness / kSurenessPerUnit;
    static_assert(kRoot * kRoot < OutlineView::kWellKnown && kRoot * kRoot > 0.99F * OutlineView::kWellKnown);
    return {hybrid.outline(), hybrid.origin, sureness != kNoOutline && sureness >= kLeastSureness};
  }

  /// A sighting for the models. At tens of frames a second those in between would say the same again: a view's weight
  /// is how far the lens has moved since the last one that was taken.
  [[gnu::noinline]] void model(const Sighting& sighting, const MeasurementNoise& noise) {
    const Vec2 lens = sighting.lens_from(origin);
    cylinder.add(sighting, origin, cylinder.first_views() == 0 ? 1.0F : novelty(lens), noise);
    cylinder_paper.add(sighting, origin);
    sheaf.add(sighting, origin);
    hybrid.add(sighting, noise);
    band.add(sighting, origin);
    cylinder.solve(lens);
    last_lens = lens;
    last_bearing = sighting.center;
    waiting = 0;
    if (cylinder.estimate().ok() && must_move()) move_arena();
    if (!sighting.left.censored) cut(left_tangent(sighting, origin));
    if (!sighting.right.censored) cut(right_tangent(sighting, origin));
    grid.refine(clip.vertices());
  }

 private:
  // The estimate has left the inner half of the arena.
  [[nodiscard]] bool must_move() const {
    if (!placed()) return true;
    constexpr float kInner = 0.75F * kArenaHalfSide;
    return arenas < kMaxArenas && cylinder.estimate().center.squaredNorm() > kInner * kInner;
  }

  // Puts the models around the estimate; clip and grid start solid again, then take the tangents that waited.
  void move_arena() {
    const MapPoint target = moved(origin, cylinder.estimate().center);
    const Vec2 shift = offset_from(origin, target);
    origin = target;
    last_lens -= shift;
    cylinder.move_origin(shift);
    cylinder_paper.move_origin(shift);
    sheaf.move_origin(shift);
    band.move_origin(shift);
    clip.start();
    grid.start();
    ++arenas;
    for (const HalfPlane& tangent : pending) cut(seen_from(tangent, shift));  // placed by now: none is kept again
    pending.clear();
  }

  void cut(const HalfPlane& tangent) {
    clip.cut(tangent);
    grid.carve(tangent);
    if (placed()) return;
    if (pending.full()) pending.erase_at(0);  // the oldest, farthest one: forgetting a cut is always safe
    static_cast<void>(pending.push_back(tangent));
  }
};

}  // namespace fencepost::recon
