// Which blob of one frame is which object. Scratch: nothing in here outlives the frame.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "firmware/recon/observe/frame_queue.hpp"
#include "firmware/recon/observe/occlusion.hpp"
#include "firmware/recon/track/assignment.hpp"
#include "firmware/recon/track/correspondence.hpp"
#include "firmware/recon/track/object.hpp"
#include "firmware/recon/track/pieces.hpp"

namespace fencepost::recon {

/// In pieces for so many frames in a row: noise does not do that, it is two objects.
inline constexpr std::uint8_t kDividingFrames = 2;

/// Called in this order for each frame: predict, see, join_pieces, match, share_merged, hide_behind_models. Then it
/// answers; objects that begin or go in the same frame are told to it.
template <class ObjectType, std::size_t kObjects>
class Matcher {
 public:
  using Objects = std::array<ObjectType, kObjects>;

  /// `place_of(o)`: where the object in slot o is, in its local frame, if something knows that better than its models.
  template <class PlaceOf>
  [[gnu::noinline]] void predict(const Objects& objects, const CameraModel& camera, const LensPose& lens,
                                 const MeasurementNoise& noise, PlaceOf&& place_of) {
    for (std::size_t o = 0; o < kObjects; ++o) {
      predictions_[o] = Prediction{};
      blob_of_[o] = kNoMatch;
      if (!objects[o].used()) continue;
      predictions_[o] = predict_one(objects[o], camera, lens, place_of(o), noise);
      predictions_[o].signature = objects[o].signature;
      predictions_[o].confirmed = objects[o].confirmed;
    }
  }

  [[gnu::noinline]] void see(const WaitingFrame& frame, const CameraModel& camera) {
    blobs_ = static_cast<std::uint8_t>(frame.blobs.size());
    for (std::size_t b = 0; b < blobs_; ++b) {
      intervals_[b] = interval_of(camera, frame.blobs[b].box);
      censor(intervals_[b], hidden_ends(frame.blobs.view(), b, camera.rows));
      object_of_[b] = kNoMatch;
    }
  }

  /// Blobs of `frame` that are pieces of one object become one. Objects that turn out to be two are marked as divided.
  void join_pieces(WaitingFrame& frame, const CameraModel& camera, const Objects& objects) {
    const auto find = [&] { return find_pieces(frame.blobs.view(), {intervals_.data(), blobs_}, predictions_); };
    in_pieces_.fill(false);
    for (PiecePair pair = find(); pair.found; pair = find()) {  // each time a blob or an object less
      if (pair.whole != kNoMatch) {
        in_pieces_[pair.whole] = true;
        if (objects[pair.whole].in_pieces >= kDividingFrames || !pair.rows_match) {
          divide(predictions_[pair.whole]);
          continue;
        }
      }
      join(frame.blobs, pair);
      see(frame, camera);
    }
  }

  /// The number of blobs that are objects known before.
  std::uint16_t match(const WaitingFrame& frame) {
    weigh_pairs(frame);
    assign(costs_, kObjects, {object_of_.data(), blobs_});
    std::uint16_t matched = 0;
    for (std::size_t b = 0; b < blobs_; ++b) {
      if (object_of_[b] == kNoMatch) continue;
      blob_of_[object_of_[b]] = static_cast<std::uint8_t>(b);
      ++matched;
    }
    return matched;
  }

  /// A blob of two objects that touch in the image gives each of them its outer end.
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

  /// A nearer object hides an end although its own blob is cut short or was not delivered.
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

  /// The ends of the object's blob that are not its own.
  [[nodiscard]] OpenEnds open_ends(std::size_t o) const {
    const Interval& interval = intervals_[blob_of_[o]];
    const Shared& shared = shared_[o];
    return {interval.left_censored || (shared.any && shared.is_right),
            interval.right_censored || (shared.any && !shared.is_right)};
  }

  /// Of a blob that two objects share, the ends and rows that are another's are not this one's.
  [[nodiscard]] BlobRays rays_for(std::size_t o, const WaitingFrame& frame, const CameraModel& camera) const {
    BlobRays rays = rays_of(frame, camera, blob_of_[o]);
    if (!shared_[o].any) return rays;
    EdgeRay& inner = shared_[o].is_right ? rays.left : rays.right;
    inner.censored = inner.foreign = true;
    rays.top.censored = rays.top.foreign = true;
    if (shared_[o].is_farther) rays.bottom.censored = rays.bottom.foreign = true;
    return rays;
  }

  /// The rays again, with what see() found out about their ends: kept apart to save 700 bytes of scratch. Ends that are
  /// near another's are doubtful besides.
  [[nodiscard]] BlobRays rays_of(const WaitingFrame& frame, const CameraModel& camera, std::size_t b) const {
    BlobRays rays = rays_of_box(camera, frame.blobs[b].box);
    rays.left.censored = intervals_[b].left_censored;
    rays.right.censored = intervals_[b].right_censored;
    rays.bottom.censored = intervals_[b].bottom_censored;
    const HiddenEnds near = hidden_ends(frame.blobs.view(), b, camera.rows, kBesidePixels);
    const HiddenEnds border = ends_near_border(frame.blobs[b].box, camera.width);
    rays.left.doubtful = near.left || border.left;
    rays.right.doubtful = near.right || border.right;
    return rays;
  }

  /// May something in the image stand before the object, as predicted?
  [[nodiscard]] bool may_be_hidden(std::size_t o) const {
    for (std::size_t b = 0; b < blobs_; ++b) {
      if (overlaps(predictions_[o], intervals_[b])) return true;
    }
    return false;
  }

  /// The object that is two now, if the blob is a good part of it.
  [[nodiscard]] const Prediction* divided_at(std::uint8_t signature, const Interval& interval) const {
    for (const Prediction& whole : predictions_) {
      const bool part = whole.divided && whole.signature == signature && has_middle_of(whole, interval);
      if (part && 3 * (interval.right - interval.left) >= whole.right.at - whole.left.at) return &whole;
    }
    return nullptr;
  }

  /// A leftover blob that may be part of an object that has a blob already: inside its interval, on the same foot; or
  /// alike and close beside it, unless it stays there. One with another foot stands elsewhere.
  [[nodiscard]] bool is_piece(const Objects& objects, const WaitingFrame& frame, std::size_t b) {
    for (std::size_t o = 0; o < kObjects; ++o) {
      if (blob_of_[o] == kNoMatch || objects[o].signature != frame.blobs[b].signature) continue;
      const WaitingBlob& taken = frame.blobs[blob_of_[o]];
      const int step = taken.box.y2 - frame.blobs[b].box.y2;
      const bool inside = covers(predictions_[o], intervals_[b]) && step <= kTouchPixels && step >= -kTouchPixels;
      const bool alike = are_alike(taken, frame.blobs[b]);
      if (alike) in_pieces_[o] = true;
      if (inside || (alike && objects[o].in_pieces < kDividingFrames)) return true;
    }
    return false;
  }

  void begin(std::size_t o, std::size_t b) {
    blob_of_[o] = static_cast<std::uint8_t>(b);
    object_of_[b] = static_cast<std::uint8_t>(o);
  }
  void drop(std::size_t o) {
    if (blob_of_[o] == kNoMatch) return;
    if (object_of_[blob_of_[o]] == o) object_of_[blob_of_[o]] = kNoMatch;
    blob_of_[o] = kNoMatch;
  }

  [[nodiscard]] std::size_t blobs() const { return blobs_; }
  [[nodiscard]] std::uint8_t blob_of(std::size_t o) const { return blob_of_[o]; }
  [[nodiscard]] bool seen(std::size_t o) const { return blob_of_[o] != kNoMatch; }
  [[nodiscard]] bool taken(std::size_t b) const { return object_of_[b] != kNoMatch; }
  [[nodiscard]] bool in_pieces(std::size_t o) const { return in_pieces_[o]; }
  [[nodiscard]] const Prediction& prediction(std::size_t o) const { return predictions_[o]; }
  [[nodiscard]] const Interval& interval(std::size_t b) const { return intervals_[b]; }

 private:
  // The object's part in a blob of two objects.
  struct Shared {
    bool any : 1 = false;
    bool is_right : 1 = false;
    bool is_farther : 1 = false;
  };
  static_assert(kObjects < kNoMatch && sensor::kMaxBlobs < kNoMatch);

  static Prediction predict_one(const ObjectType& object, const CameraModel& camera, const LensPose& lens,
                                const std::optional<CylinderEstimate>& place, const MeasurementNoise& noise) {
    if (place) return recon::predict(camera, lens, object, *place, noise);
    if constexpr (ObjectType::kPredictsByOutline) {
      return recon::predict(camera, lens, object, object.placed_outline(), noise);
    } else {
      return recon::predict(camera, lens, object, object.cylinder.estimate(), noise);
    }
  }

  // Two objects that were taken for one, and never stood apart in the image before: nothing matches it any more.
  static void divide(Prediction& prediction) {
    prediction.divided = true;
    prediction.possible = false;
    prediction.depth = 0;
  }

  void weigh_pairs(const WaitingFrame& frame) {
    for (std::size_t o = 0; o < kObjects; ++o) {
      for (std::size_t b = 0; b < blobs_; ++b) {
        const bool may = predictions_[o].possible && predictions_[o].signature == frame.blobs[b].signature;
        costs_[o * blobs_ + b] = may ? match_cost(predictions_[o], intervals_[b], frame.blobs[b].box) : kImpossible;
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
