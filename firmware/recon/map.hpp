// The map: all objects, and what one frame does to them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "firmware/recon/digest.hpp"
#include "firmware/recon/localize/pose_correction.hpp"
#include "firmware/recon/models/hybrid/outline_fitter.hpp"
#include "firmware/recon/observe/frame_queue.hpp"
#include "firmware/recon/track/matcher.hpp"
#include "firmware/recon/track/object.hpp"
#include "firmware/recon/track/object_events.hpp"

namespace fencepost::recon {

/// k sightings in the last n frames in which the object could be seen confirm it.
struct Confirmation {
  int k = 3;
  int n = 5;
};

/// What became of one frame.
struct FrameOutcome {
  std::uint16_t matched = 0;
  std::uint16_t born = 0;
  std::uint16_t pieces = 0;   ///< blobs that are part of an object matched already
  std::uint16_t refused = 0;  ///< blobs that might be new objects, but the table was full of confirmed ones
};

template <class Profile>
class Map {
 public:
  using ObjectType = Object<Profile>;

  void clear() {
    for (ObjectType& object : objects_) object.id = 0;
    events_.clear();
    fitter_.clear();
    correction_.clear();
    next_id_ = 1;
    frames_ = 0;
    evicted_ = 0;
    digest_ = base::Fnv1a64::kOffsetBasis;
  }

  /// One frame through the whole algorithm. `odometry`: where the robot was at the exposure, by odometry alone;
  /// `drift`: by what share of the distance that may be off; more than 0, the objects correct it. Blobs of `frame`
  /// that are pieces of one object are joined in place.
  FrameOutcome add_frame(WaitingFrame& frame, const CameraModel& camera, const MapPose& odometry,
                         const MeasurementNoise& noise, Confirmation confirmation, float drift = 0) {
    events_.clear();
    exposure_ = frame.t - camera.latency;
    MapPose pose = correction_.drive(odometry, drift);
    LensPose lens = lens_pose(pose, camera);
    matcher_.predict(objects_, camera, lens, noise,
                     [&](std::size_t o) { return correction_.place_of(objects_[o], o); });
    matcher_.see(frame, camera);
    matcher_.join_pieces(frame, camera, objects_);
    retire_divided();
    FrameOutcome outcome;
    outcome.matched = matcher_.match(frame);
    matcher_.share_merged(frame);
    matcher_.hide_behind_models();
    if (drift > 0) {
      pose = correction_.correct(objects_, matcher_, frame, camera, noise);
      lens = lens_pose(pose, camera);
    }
    track_matched(frame, camera, lens);
    notice_missing();
    begin_new(frame, camera, lens, outcome);
    update_models(frame, camera, lens, correction_.model_noise(noise));
    count_pieces();
    fitter_.fit(objects_);
    drop_doubles();
    forget_refuted();
    confirm(confirmation);
    correction_.follow(objects_, matcher_, frame, camera, noise);
    chain_digest(frame, pose);
    return outcome;
  }

  /// Where the robot is in the map, by odometry and all corrections so far.
  [[nodiscard]] MapPose corrected(const MapPose& odometry) const { return correction_.corrected(odometry); }
  [[nodiscard]] const PoseCorrection<Profile>& correction() const { return correction_; }

  [[nodiscard]] std::span<const ObjectType> slots() const { return objects_; }
  [[nodiscard]] std::uint64_t digest() const { return digest_; }
  [[nodiscard]] std::uint32_t frames() const { return frames_; }
  [[nodiscard]] std::uint32_t evicted() const { return evicted_; }
  [[nodiscard]] std::uint32_t size() const {
    std::uint32_t count = 0;
    for (const ObjectType& object : objects_) count += object.used() ? 1U : 0U;
    return count;
  }
  /// What became of objects in the last frame, in order.
  [[nodiscard]] std::span<const ObjectEvent> events() const { return events_.view(); }
  /// True if the object in this slot was seen in the last frame.
  [[nodiscard]] bool seen_now(std::size_t slot) const { return matcher_.seen(slot); }
  /// The blob that the object in this slot took in the last frame (its order in the WaitingFrame), or kNoMatch.
  [[nodiscard]] std::uint8_t blob_of(std::size_t slot) const { return matcher_.blob_of(slot); }

 private:
  static constexpr std::size_t kObjects = Profile::kObjects;

  // Two objects that were taken for one: both begin anew.
  void retire_divided() {
    for (std::size_t o = 0; o < kObjects; ++o) {
      if (matcher_.prediction(o).divided) end(o, EventKind::kDivided);
    }
  }

  [[nodiscard]] Sighting sighting_of(std::size_t o, const WaitingFrame& frame, const CameraModel& camera,
                                     const LensPose& lens) const {
    return make_sighting(camera, lens, matcher_.rays_for(o, frame, camera));
  }

  void track_matched(const WaitingFrame& frame, const CameraModel& camera, const LensPose& lens) {
    for (std::size_t o = 0; o < kObjects; ++o) {
      if (!matcher_.seen(o)) continue;
      ObjectType& object = objects_[o];
      const OpenEnds ends = matcher_.open_ends(o);
      compare_ends(object, matcher_.prediction(o), matcher_.interval(matcher_.blob_of(o)), ends);
      if (object.contradicted()) {
        object.restart(sighting_of(o, frame, camera, lens), exposure_);
        correction_.forget(o);
        report(EventKind::kMoved, o);
      }
      object.track(ends, exposure_);
      object.history.push(true);
      object.presence += kPresenceGain * (1.0F - object.presence);
    }
  }

  void notice_missing() {
    for (std::size_t o = 0; o < kObjects; ++o) {
      ObjectType& object = objects_[o];
      const Prediction& prediction = matcher_.prediction(o);
      if (!object.used() || matcher_.seen(o) || !prediction.possible) continue;
      if (!prediction.expected && object.confirmed) continue;
      if (matcher_.may_be_hidden(o)) continue;
      object.history.push(false);
      if (!prediction.expected) continue;
      object.presence -= kPresenceGain * object.presence;
      if (object.missed_in_a_row < 0xFFFF) ++object.missed_in_a_row;
    }
  }

  void begin_new(const WaitingFrame& frame, const CameraModel& camera, const LensPose& lens, FrameOutcome& outcome) {
    for (std::size_t b = 0; b < matcher_.blobs(); ++b) {
      const Interval& interval = matcher_.interval(b);
      if (matcher_.taken(b) || (interval.left_censored && interval.right_censored)) continue;
      const Prediction* divided = matcher_.divided_at(frame.blobs[b].signature, interval);
      if (!divided && matcher_.is_piece(objects_, frame, b)) {
        ++outcome.pieces;
        continue;
      }
      const std::size_t slot = slot_for_new();
      if (slot == kObjects) {
        ++outcome.refused;
        continue;
      }
      matcher_.begin(slot, b);
      objects_[slot].begin(next_id_++, frame.blobs[b].signature, sighting_of(slot, frame, camera, lens), exposure_);
      if (next_id_ == 0) next_id_ = 1;
      report(EventKind::kBorn, slot);
      objects_[slot].confirmed = divided && divided->confirmed;  // what it is a part of was known: so is this
      objects_[slot].track(matcher_.open_ends(slot), exposure_);
      objects_[slot].history.push(true);
      ++outcome.born;
    }
  }

  // Most of a frame's work, so a small part does it for few objects a frame.
  [[gnu::noinline]] void update_models(const WaitingFrame& frame, const CameraModel& camera, const LensPose& lens,
                                       const MeasurementNoise& noise) {
    const std::size_t nearest = lowest_foot(frame);
    for (std::size_t turn = 0; turn < Profile::kModelTurns; ++turn) {
      const std::size_t o = most_urgent(frame, nearest);
      if (o == kObjects) return;
      objects_[o].model(sighting_of(o, frame, camera, lens), noise);
    }
  }

  [[nodiscard]] std::int16_t foot_of(std::size_t o, const WaitingFrame& frame) const {
    return frame.blobs[matcher_.blob_of(o)].box.y2;
  }
  // Of the objects seen in this frame the one whose foot is lowest in the image: the robot is about to hit that one.
  [[nodiscard]] std::size_t lowest_foot(const WaitingFrame& frame) const {
    std::size_t lowest = kObjects;
    for (std::size_t o = 0; o < kObjects; ++o) {
      if (!matcher_.seen(o)) continue;
      if (lowest == kObjects || foot_of(o, frame) > foot_of(lowest, frame)) lowest = o;
    }
    return lowest;
  }

  // Of the objects seen in this frame the one that has waited longest for its models' turn; `nearest` waits twice as
  // long as others. Of two the nearer one. kObjects if none waits. Nobody waits for ever: what is new or near goes
  // before others for as long as they have waited less than twice the capacity.
  [[nodiscard]] std::size_t most_urgent(const WaitingFrame& frame, std::size_t nearest) const {
    std::size_t urgent = kObjects;
    int longest = 0;
    for (std::size_t o = 0; o < kObjects; ++o) {
      if (!matcher_.seen(o) || objects_[o].waiting == 0) continue;
      const int waited = objects_[o].waiting * (o == nearest ? 2 : 1);
      const bool before = waited == longest && foot_of(o, frame) > foot_of(urgent, frame);
      if (waited < longest || (waited == longest && !before)) continue;
      urgent = o;
      longest = waited;
    }
    return urgent;
  }

  void count_pieces() {
    for (std::size_t o = 0; o < kObjects; ++o) {
      std::uint8_t& frames = objects_[o].in_pieces;
      if (!matcher_.in_pieces(o)) frames = 0;
      if (matcher_.in_pieces(o) && frames < kDividingFrames) ++frames;
    }
  }

  // A free slot; else that of the least useful tentative object not seen in this frame: fewest views, then longest
  // unseen, then the older id; else that of the confirmed one that is longest out of sight, or a robot with a small
  // table would be blind to new places. kObjects if all were seen lately.
  std::size_t slot_for_new() {
    std::size_t tentative = kObjects;
    std::size_t old = kObjects;
    for (std::size_t o = 0; o < kObjects; ++o) {
      if (!objects_[o].used()) return o;
      if (matcher_.seen(o)) continue;
      if (objects_[o].confirmed) {
        const bool stale = exposure_ - objects_[o].last_seen > kOutOfSight;
        if (stale && (old == kObjects || objects_[o].last_seen < objects_[old].last_seen)) old = o;
      } else if (tentative == kObjects || less_useful(objects_[o], objects_[tentative])) {
        tentative = o;
      }
    }
    const std::size_t best = tentative != kObjects ? tentative : old;
    if (best != kObjects) {
      ++evicted_;
      end(best, EventKind::kEvicted);
    }
    return best;
  }
  static bool less_useful(const ObjectCore& a, const ObjectCore& b) {
    if (a.views != b.views) return a.views < b.views;
    if (a.last_seen != b.last_seen) return a.last_seen < b.last_seen;
    return a.id < b.id;
  }

  // Solid things do not stand in one another: of two objects of one signature in one place, one is a double. Not when
  // both were seen in this frame.
  void drop_doubles() {
    for (std::size_t a = 0; a < kObjects; ++a) {
      for (std::size_t b = a + 1; b < kObjects && objects_[a].used(); ++b) {
        if (!objects_[b].used() || objects_[a].signature != objects_[b].signature) continue;
        if (matcher_.seen(a) && matcher_.seen(b)) continue;
        if (!stand_in_one_place(objects_[a], objects_[b])) continue;
        const std::size_t kept = weight(objects_[a]) >= weight(objects_[b]) ? a : b;
        end(kept == a ? b : a, EventKind::kMerged, objects_[kept].id);
      }
    }
  }
  static float weight(const ObjectCore& object) { return object.presence * static_cast<float>(object.views); }

  // A single sighting beside a confirmed object was noise. What was hardly ever seen, and should have been again and
  // again, never was. Of a better known object real cameras miss more than that: it stays, and only its alerts stop.
  void forget_refuted() {
    for (std::size_t o = 0; o < kObjects; ++o) {
      const ObjectType& object = objects_[o];
      if (!object.used() || exposure_ - object.last_seen < kKeepUnseen) continue;
      const bool once = object.views == 1 && has_better_namesake(o);
      if (once || (object.missed_in_a_row >= kRefutingMisses && object.views < kFewViews)) end(o, EventKind::kDeleted);
    }
  }

  [[nodiscard]] bool has_better_namesake(std::size_t o) const {
    return std::any_of(objects_.begin(), objects_.end(), [&](const ObjectType& other) {
      return other.used() && other.confirmed && other.id != objects_[o].id && other.signature == objects_[o].signature;
    });
  }

  // The only way in which an object ends.
  void end(std::size_t o, EventKind kind, std::uint32_t other = 0) {
    report(kind, o, other);
    objects_[o].id = 0;
    matcher_.drop(o);
  }
  void report(EventKind kind, std::size_t o, std::uint32_t other = 0) {
    static_cast<void>(events_.push_back({kind, static_cast<std::uint8_t>(o), objects_[o].id, other}));
  }

  void confirm(Confirmation confirmation) {
    for (ObjectType& object : objects_) {
      const bool placed = object.used() && object.cylinder.estimate().ok();
      if (placed && object.history.seen_of_last(confirmation.n) >= confirmation.k) object.confirmed = true;
    }
  }

  [[gnu::noinline]] void chain_digest(const WaitingFrame& frame, const MapPose& pose) {
    base::Fnv1a64 hash;
    hash.i64(static_cast<std::int64_t>(digest_));
    hash.u32(frame.frame);
    hash.i64(exposure_.raw);
    hash_pose(hash, pose);
    hash.u32(size());
    hash.u32(next_id_);
    for (std::size_t o = 0; o < kObjects; ++o) {
      if (objects_[o].used() && matcher_.seen(o)) hash_sighted(hash, objects_[o]);
    }
    const ObjectType& turn = objects_[frames_ % kObjects];
    if (turn.used()) hash_part(hash, turn, frames_ / kObjects % kDigestParts);
    if (correction_.running()) hash_filter(hash, correction_.filter(), frames_ % kObjects);
    ++frames_;
    digest_ = hash.value();
  }

  // Presence is averaged over about this many expected sightings.
  static constexpr float kPresenceGain = 1.0F / 8.0F;
  static constexpr std::uint32_t kRefutingMisses = 12;
  static constexpr std::uint32_t kFewViews = 8;
  static constexpr base::Duration kOutOfSight = base::milliseconds(5000);
  static constexpr base::Duration kKeepUnseen = base::milliseconds(1000);

  std::array<ObjectType, kObjects> objects_{};
  std::uint32_t next_id_ = 1;
  std::uint32_t frames_ = 0;
  std::uint32_t evicted_ = 0;
  std::uint64_t digest_ = base::Fnv1a64::kOffsetBasis;

  ObjectEvents<kObjects> events_;
  base::Time exposure_;  ///< of the current frame
  Matcher<ObjectType, kObjects> matcher_;
  OutlineFitter<Profile> fitter_;
  PoseCorrection<Profile> correction_;
};

}  // namespace fencepost::recon
