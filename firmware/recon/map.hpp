// The map: all objects, and what one frame does to them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "firmware/recon/assignment.hpp"
#include "firmware/recon/correspondence.hpp"
#include "firmware/recon/digest.hpp"
#include "firmware/recon/frame_queue.hpp"
#include "firmware/recon/object.hpp"
#include "firmware/recon/occlusion.hpp"
#include "firmware/recon/pieces.hpp"

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
    next_id_ = 1;
    frames_ = 0;
    evicted_ = 0;
    digest_ = base::Fnv1a64::kOffsetBasis;
  }

  /// One frame at its exposure pose, through the whole algorithm. Blobs of `frame` that are pieces of one object are
  /// joined in place.
  FrameOutcome add_frame(WaitingFrame& frame, const CameraModel& camera, const MapPose& pose,
                         const MeasurementNoise& noise, Confirmation confirmation) {
    exposure_ = frame.t - camera.latency;
    const LensPose lens = lens_pose(pose, camera);
    predict_all(camera, lens, noise);
    see_blobs(frame, camera);
    join_pieces(frame, camera);
    weigh_pairs(frame);
    FrameOutcome outcome;
    outcome.matched = match();
    share_merged(frame);
    hide_behind_models();
    update_matched(frame, camera, lens, noise);
    notice_missing();
    begin_new(frame, camera, lens, noise, outcome);
    count_pieces();
    drop_doubles();
    forget_refuted();
    confirm(confirmation);
    chain_digest(frame, pose);
    return outcome;
  }

  [[nodiscard]] std::span<const ObjectType> slots() const { return objects_; }
  [[nodiscard]] std::uint64_t digest() const { return digest_; }
  [[nodiscard]] std::uint32_t frames() const { return frames_; }
  [[nodiscard]] std::uint32_t evicted() const { return evicted_; }
  [[nodiscard]] std::uint32_t size() const {
    std::uint32_t count = 0;
    for (const ObjectType& object : objects_) count += object.used() ? 1U : 0U;
    return count;
  }
  /// True if the object in this slot was seen in the last frame.
  [[nodiscard]] bool seen_now(std::size_t slot) const { return blob_of_[slot] != kNoMatch; }
  /// The blob that the object in this slot took in the last frame (its order in the WaitingFrame), or kNoMatch.
  [[nodiscard]] std::uint8_t blob_of(std::size_t slot) const { return blob_of_[slot]; }

 private:
  static constexpr std::size_t kObjects = Profile::kObjects;

  // This object's part in a blob of two objects.
  struct Shared {
    bool any : 1 = false;
    bool is_right : 1 = false;
    bool is_farther : 1 = false;
  };
  static_assert(kObjects < kNoMatch && sensor::kMaxBlobs < kNoMatch);

  void predict_all(const CameraModel& camera, const LensPose& lens, const MeasurementNoise& noise) {
    for (std::size_t o = 0; o < kObjects; ++o) {
      predictions_[o] = objects_[o].used() ? predict(camera, lens, objects_[o], noise) : Prediction{};
      blob_of_[o] = kNoMatch;
    }
  }

  void see_blobs(const WaitingFrame& frame, const CameraModel& camera) {
    blobs_ = static_cast<std::uint8_t>(frame.blobs.size());
    for (std::size_t b = 0; b < blobs_; ++b) {
      BlobRays rays = rays_of_box(camera, frame.blobs[b].box);
      censor(rays, hidden_ends(frame.blobs.view(), b, camera.rows));
      intervals_[b] = interval_of(camera, rays);
      object_of_[b] = kNoMatch;
    }
  }

  void join_pieces(WaitingFrame& frame, const CameraModel& camera) {
    const auto find = [&] { return find_pieces(frame.blobs.view(), {intervals_.data(), blobs_}, predictions_); };
    in_pieces_.fill(false);
    for (PiecePair pair = find(); pair.found; pair = find()) {  // each time a blob or an object less
      if (pair.whole != kNoMatch) {
        in_pieces_[pair.whole] = true;
        if (objects_[pair.whole].in_pieces >= kDividingFrames || !pair.rows_match) {
          divide(pair.whole);
          continue;
        }
      }
      join(frame.blobs, pair);
      see_blobs(frame, camera);
    }
  }
  // Two objects that were taken for one, and never stood apart in the image before: both begin anew.
  void divide(std::size_t o) {
    objects_[o].id = 0;
    predictions_[o].divided = true;
    predictions_[o].possible = false;
    predictions_[o].depth = 0;
  }
  // The rays again, with what see_blobs found out about their ends: kept apart to save 700 bytes of scratch.
  [[nodiscard]] BlobRays rays_of(const WaitingFrame& frame, const CameraModel& camera, std::size_t b) const {
    BlobRays rays = rays_of_box(camera, frame.blobs[b].box);
    rays.left.censored = intervals_[b].left_censored;
    rays.right.censored = intervals_[b].right_censored;
    rays.bottom.censored = intervals_[b].bottom_censored;
    return rays;
  }

  void weigh_pairs(const WaitingFrame& frame) {
    for (std::size_t o = 0; o < kObjects; ++o) {
      for (std::size_t b = 0; b < blobs_; ++b) {
        const bool may = objects_[o].used() && objects_[o].signature == frame.blobs[b].signature;
        costs_[o * blobs_ + b] = may ? match_cost(predictions_[o], intervals_[b], frame.blobs[b].box) : kImpossible;
      }
    }
  }

  std::uint16_t match() {
    assign(costs_, kObjects, {object_of_.data(), blobs_});
    std::uint16_t matched = 0;
    for (std::size_t b = 0; b < blobs_; ++b) {
      if (object_of_[b] == kNoMatch) continue;
      blob_of_[object_of_[b]] = static_cast<std::uint8_t>(b);
      ++matched;
    }
    return matched;
  }

  // A blob of two objects that touch in the image gives each of them its outer end.
  void share_merged(const WaitingFrame& frame) {
    shared_.fill(Shared{});
    for (std::size_t b = 0; b < blobs_; ++b) {
      for (std::size_t left = 0; left < kObjects; ++left) {
        for (std::size_t right = 0; right < kObjects; ++right) {
          if (may_share(left, right, frame, b)) share(left, right, b);
        }
      }
    }
  }
  [[nodiscard]] bool may_share(std::size_t left, std::size_t right, const WaitingFrame& frame, std::size_t b) const {
    const std::uint8_t signature = frame.blobs[b].signature;
    if (left == right || predictions_[left].signature != signature || predictions_[right].signature != signature) {
      return false;
    }
    const std::uint8_t taken = object_of_[b];
    const auto unseen = [&](std::size_t o) { return blob_of_[o] == kNoMatch && !shared_[o].any; };
    const bool one_has_it = (taken == left && unseen(right)) || (taken == right && unseen(left));
    if (!one_has_it && !(taken == kNoMatch && unseen(left) && unseen(right))) return false;
    return shows_both(predictions_[left], predictions_[right], intervals_[b], frame.blobs[b].box);
  }
  void share(std::size_t left, std::size_t right, std::size_t b) {
    const float left_depth = predictions_[left].depth, right_depth = predictions_[right].depth;
    const bool left_is_nearer = left_depth > 0 && (!(right_depth > 0) || left_depth < right_depth);
    shared_[left] = {true, false, !left_is_nearer};
    shared_[right] = {true, true, left_is_nearer};
    blob_of_[left] = blob_of_[right] = static_cast<std::uint8_t>(b);
    object_of_[b] = static_cast<std::uint8_t>(left);
  }

  // A nearer object hides an end although its own blob is cut short or was not delivered.
  void hide_behind_models() {
    for (std::size_t b = 0; b < blobs_; ++b) {
      if (object_of_[b] == kNoMatch || shared_[object_of_[b]].any) continue;
      const Prediction& own = predictions_[object_of_[b]];
      for (std::size_t o = 0; o < kObjects; ++o) {
        if (o == object_of_[b]) continue;
        if (hides_end(predictions_[o], own, intervals_[b].left, -1)) intervals_[b].left_censored = true;
        if (hides_end(predictions_[o], own, intervals_[b].right, 1)) intervals_[b].right_censored = true;
      }
    }
  }

  // Of a blob that two objects share, the ends and rows that are another's are not this one's.
  [[nodiscard]] BlobRays rays_for(std::size_t o, const WaitingFrame& frame, const CameraModel& camera) const {
    BlobRays rays = rays_of(frame, camera, blob_of_[o]);
    if (!shared_[o].any) return rays;
    (shared_[o].is_right ? rays.left : rays.right).censored = true;
    rays.top.censored = true;
    if (shared_[o].is_farther) rays.bottom.censored = true;
    return rays;
  }

  void update_matched(const WaitingFrame& frame, const CameraModel& camera, const LensPose& lens,
                      const MeasurementNoise& noise) {
    for (std::size_t o = 0; o < kObjects; ++o) {
      if (blob_of_[o] == kNoMatch) continue;
      ObjectType& object = objects_[o];
      const BlobRays rays = rays_for(o, frame, camera);
      const Sighting sighting = make_sighting(camera, lens, rays);
      compare_ends(object, predictions_[o], intervals_[blob_of_[o]], rays);
      if (object.contradicted()) object.restart(sighting, exposure_);
      object.observe(sighting, exposure_, noise);
      object.history.push(true);
      object.presence += kPresenceGain * (1.0F - object.presence);
    }
  }

  void notice_missing() {
    for (std::size_t o = 0; o < kObjects; ++o) {
      ObjectType& object = objects_[o];
      if (!object.used() || blob_of_[o] != kNoMatch) continue;
      if (!predictions_[o].expected && object.confirmed) continue;
      if (!predictions_[o].possible) continue;
      if (may_be_hidden(o)) continue;
      object.history.push(false);
      if (!predictions_[o].expected) continue;
      object.presence -= kPresenceGain * object.presence;
      if (object.missed_in_a_row < 0xFFFF) ++object.missed_in_a_row;
    }
  }

  [[nodiscard]] bool may_be_hidden(std::size_t o) const {
    for (std::size_t b = 0; b < blobs_; ++b) {
      if (overlaps(predictions_[o], intervals_[b])) return true;
    }
    return false;
  }

  void begin_new(const WaitingFrame& frame, const CameraModel& camera, const LensPose& lens,
                 const MeasurementNoise& noise, FrameOutcome& outcome) {
    for (std::size_t b = 0; b < blobs_; ++b) {
      if (object_of_[b] != kNoMatch) continue;
      if (intervals_[b].left_censored && intervals_[b].right_censored) continue;
      const Prediction* divided = divided_at(frame.blobs[b].signature, intervals_[b]);
      if (!divided && is_piece(frame, b)) {
        ++outcome.pieces;
        continue;
      }
      const std::size_t slot = slot_for_new();
      if (slot == kObjects) {
        ++outcome.refused;
        continue;
      }
      const Sighting sighting = make_sighting(camera, lens, rays_of(frame, camera, b));
      objects_[slot].begin(next_id_++, frame.blobs[b].signature, sighting, exposure_);
      if (next_id_ == 0) next_id_ = 1;
      objects_[slot].confirmed = divided && divided->confirmed;
      objects_[slot].observe(sighting, exposure_, noise);
      objects_[slot].history.push(true);
      blob_of_[slot] = static_cast<std::uint8_t>(b);
      object_of_[b] = static_cast<std::uint8_t>(slot);
      ++outcome.born;
    }
  }

  // The object that is two now, if the blob is a good part of it. What it is a part of was known: so is this.
  [[nodiscard]] const Prediction* divided_at(std::uint8_t signature, const Interval& interval) const {
    for (const Prediction& whole : predictions_) {
      const bool part = whole.divided && whole.signature == signature && has_middle_of(whole, interval);
      if (part && 3 * (interval.right - interval.left) >= whole.right.at - whole.left.at) return &whole;
    }
    return nullptr;
  }

  // A leftover blob that may be part of an object that has a blob already: inside its interval, on the same foot; or
  // alike and close beside it, unless it stays there. One with another foot stands elsewhere.
  [[nodiscard]] bool is_piece(const WaitingFrame& frame, std::size_t b) {
    for (std::size_t o = 0; o < kObjects; ++o) {
      if (blob_of_[o] == kNoMatch || objects_[o].signature != frame.blobs[b].signature) continue;
      const WaitingBlob& taken = frame.blobs[blob_of_[o]];
      const int step = taken.box.y2 - frame.blobs[b].box.y2;
      const bool inside = covers(predictions_[o], intervals_[b]) && step <= kTouchPixels && step >= -kTouchPixels;
      const bool beside = are_alike(taken, frame.blobs[b]) && objects_[o].in_pieces < kDividingFrames;
      if (are_alike(taken, frame.blobs[b])) in_pieces_[o] = true;
      if (inside || beside) return true;
    }
    return false;
  }

  void count_pieces() {
    for (std::size_t o = 0; o < kObjects; ++o) {
      std::uint8_t& frames = objects_[o].in_pieces;
      if (!in_pieces_[o]) frames = 0;
      if (in_pieces_[o] && frames < kDividingFrames) ++frames;
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
      if (blob_of_[o] != kNoMatch) continue;
      if (objects_[o].confirmed) {
        const bool stale = exposure_ - objects_[o].last_seen > kOutOfSight;
        if (stale && (old == kObjects || objects_[o].last_seen < objects_[old].last_seen)) old = o;
      } else if (tentative == kObjects || less_useful(objects_[o], objects_[tentative])) {
        tentative = o;
      }
    }
    const std::size_t best = tentative != kObjects ? tentative : old;
    if (best != kObjects) ++evicted_;
    return best;
  }
  static bool less_useful(const ObjectCore& a, const ObjectCore& b) {
    if (a.views != b.views) return a.views < b.views;
    if (a.last_seen != b.last_seen) return a.last_seen < b.last_seen;
    return a.id < b.id;
  }

  // Solid things do not stand in one another: of two objects of one signature in one place, one is a double. Not when
  // both were seen in this frame, each in its own blob.
  void drop_doubles() {
    for (std::size_t a = 0; a < kObjects; ++a) {
      for (std::size_t b = a + 1; b < kObjects && objects_[a].used(); ++b) {
        if (!objects_[b].used() || objects_[a].signature != objects_[b].signature) continue;
        if (blob_of_[a] != kNoMatch && blob_of_[b] != kNoMatch) continue;
        if (!stand_in_one_place(objects_[a], objects_[b])) continue;
        drop(weight(objects_[a]) >= weight(objects_[b]) ? b : a);
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
      if (once || (object.missed_in_a_row >= kRefutingMisses && object.views < kFewViews)) drop(o);
    }
  }

  [[nodiscard]] bool has_better_namesake(std::size_t o) const {
    return std::any_of(objects_.begin(), objects_.end(), [&](const ObjectType& other) {
      return other.used() && other.confirmed && other.id != objects_[o].id && other.signature == objects_[o].signature;
    });
  }

  void drop(std::size_t o) {
    objects_[o].id = 0;
    if (blob_of_[o] == kNoMatch) return;
    if (object_of_[blob_of_[o]] == o) object_of_[blob_of_[o]] = kNoMatch;
    blob_of_[o] = kNoMatch;
  }

  void confirm(Confirmation confirmation) {
    for (ObjectType& object : objects_) {
      const bool placed = object.used() && object.cylinder.estimate().ok();
      if (placed && object.history.seen_of_last(confirmation.n) >= confirmation.k) object.confirmed = true;
    }
  }

  void chain_digest(const WaitingFrame& frame, const MapPose& pose) {
    base::Fnv1a64 hash;
    hash.i64(static_cast<std::int64_t>(digest_));
    hash.u32(frame.frame);
    hash.i64(exposure_.raw);
    hash_pose(hash, pose);
    hash.u32(size());
    hash.u32(next_id_);
    for (std::size_t o = 0; o < kObjects; ++o) {
      if (objects_[o].used() && blob_of_[o] != kNoMatch) hash_core(hash, objects_[o]);
    }
    const ObjectType& turn = objects_[frames_ % kObjects];
    if (turn.used()) hash_object(hash, turn);
    ++frames_;
    digest_ = hash.value();
  }

  // Presence is averaged over about this many expected sightings.
  static constexpr float kPresenceGain = 1.0F / 8.0F;
  static constexpr std::uint32_t kRefutingMisses = 12;
  static constexpr std::uint32_t kFewViews = 8;
  static constexpr base::Duration kOutOfSight = base::milliseconds(5000);
  static constexpr base::Duration kKeepUnseen = base::milliseconds(1000);
  // In pieces for so many frames in a row: noise does not do that, it is two objects.
  static constexpr std::uint8_t kDividingFrames = 2;

  std::array<ObjectType, kObjects> objects_{};
  std::uint32_t next_id_ = 1;
  std::uint32_t frames_ = 0;
  std::uint32_t evicted_ = 0;
  std::uint64_t digest_ = base::Fnv1a64::kOffsetBasis;

  // Scratch of the current frame.
  base::Time exposure_;
  std::array<Prediction, kObjects> predictions_{};
  std::array<Interval, sensor::kMaxBlobs> intervals_{};
  std::array<std::uint8_t, kObjects * sensor::kMaxBlobs> costs_{};  ///< [object][blob], as many columns as blobs
  std::array<std::uint8_t, kObjects> blob_of_{};
  std::array<Shared, kObjects> shared_{};
  std::array<bool, kObjects> in_pieces_{};
  std::array<std::uint8_t, sensor::kMaxBlobs> object_of_{};
  std::uint8_t blobs_ = 0;
};

}  // namespace fencepost::recon
