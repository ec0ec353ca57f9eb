// The map: all objects, and what one frame does to them.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "firmware/recon/assignment.hpp"
#include "firmware/recon/correspondence.hpp"
#include "firmware/recon/digest.hpp"
#include "firmware/recon/frame_queue.hpp"
#include "firmware/recon/object.hpp"
#include "firmware/recon/occlusion.hpp"

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
    join_pieces(frame, camera);
    see_blobs(frame, camera);
    weigh_pairs(frame);
    FrameOutcome outcome;
    outcome.matched = match();
    update_matched(frame, camera, lens, noise);
    notice_missing();
    begin_new(frame, camera, lens, noise, outcome);
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
  static_assert(kObjects < kNoMatch && sensor::kMaxBlobs < kNoMatch);

  void predict_all(const CameraModel& camera, const LensPose& lens, const MeasurementNoise& noise) {
    for (std::size_t o = 0; o < kObjects; ++o) {
      predictions_[o] = objects_[o].used() ? predict(camera, lens, objects_[o], noise) : Prediction{};
      blob_of_[o] = kNoMatch;
    }
  }

  // Two pieces behind a post are one object, unless two objects are known to be there.
  void join_pieces(WaitingFrame& frame, const CameraModel& camera) {
    CutPair pair = find_cut_pair(frame.blobs.view(), 0, 0);
    while (pair.found) {
      if (known_apart(frame, camera, pair)) {
        pair = find_cut_pair(frame.blobs.view(), pair.left, pair.right + 1U);
      } else {
        join(frame.blobs, pair);
        pair = find_cut_pair(frame.blobs.view(), 0, 0);  // fewer blobs now: at most 15 times
      }
    }
  }

  [[nodiscard]] bool known_apart(const WaitingFrame& frame, const CameraModel& camera, const CutPair& pair) const {
    const Interval left = interval_of(camera, rays_of_box(camera, frame.blobs[pair.left].box));
    const Interval right = interval_of(camera, rays_of_box(camera, frame.blobs[pair.right].box));
    bool one = false;
    bool other = false;
    for (std::size_t o = 0; o < kObjects; ++o) {
      if (!objects_[o].used() || objects_[o].signature != frame.blobs[pair.left].signature) continue;
      if (!(predictions_[o].depth > 0)) continue;
      const bool on_left = overlaps(predictions_[o], left);
      const bool on_right = overlaps(predictions_[o], right);
      one = one || (on_left && !on_right);
      other = other || (on_right && !on_left);
    }
    return one && other;
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

  void update_matched(const WaitingFrame& frame, const CameraModel& camera, const LensPose& lens,
                      const MeasurementNoise& noise) {
    for (std::size_t o = 0; o < kObjects; ++o) {
      if (blob_of_[o] == kNoMatch) continue;
      objects_[o].observe(make_sighting(camera, lens, rays_of(frame, camera, blob_of_[o])), exposure_, noise);
      objects_[o].history.push(true);
      objects_[o].presence += kPresenceGain * (1.0F - objects_[o].presence);
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
      if (is_piece(frame, b)) {
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
      objects_[slot].observe(sighting, exposure_, noise);
      objects_[slot].history.push(true);
      blob_of_[slot] = static_cast<std::uint8_t>(b);
      object_of_[b] = static_cast<std::uint8_t>(slot);
      ++outcome.born;
    }
  }

  // A leftover blob inside the interval of an object that is matched already, at the same height in the image: a piece
  // that noise split off. One with another foot stands elsewhere.
  [[nodiscard]] bool is_piece(const WaitingFrame& frame, std::size_t b) const {
    for (std::size_t o = 0; o < kObjects; ++o) {
      if (blob_of_[o] == kNoMatch || objects_[o].signature != frame.blobs[b].signature) continue;
      const int step = frame.blobs[blob_of_[o]].box.y2 - frame.blobs[b].box.y2;
      if (step > kTouchPixels || step < -kTouchPixels) continue;
      if (covers(predictions_[o], intervals_[b])) return true;
    }
    return false;
  }

  // A free slot, else that of the least useful tentative object not seen in this frame: fewest views, then longest
  // unseen, then the older id. kObjects if there is none.
  std::size_t slot_for_new() {
    std::size_t best = kObjects;
    for (std::size_t o = 0; o < kObjects; ++o) {
      if (!objects_[o].used()) return o;
      if (objects_[o].confirmed || blob_of_[o] != kNoMatch) continue;
      if (best == kObjects || less_useful(objects_[o], objects_[best])) best = o;
    }
    if (best != kObjects) ++evicted_;
    return best;
  }
  static bool less_useful(const ObjectCore& a, const ObjectCore& b) {
    if (a.views != b.views) return a.views < b.views;
    if (a.last_seen != b.last_seen) return a.last_seen < b.last_seen;
    return a.id < b.id;
  }

  void confirm(Confirmation confirmation) {
    for (ObjectType& object : objects_) {
      if (object.used() && !object.confirmed && object.history.seen_of_last(confirmation.n) >= confirmation.k) {
        object.confirmed = true;
      }
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
  std::array<std::uint8_t, sensor::kMaxBlobs> object_of_{};
  std::uint8_t blobs_ = 0;
};

}  // namespace fencepost::recon
