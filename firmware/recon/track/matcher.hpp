// Which blob of one frame is which object. Scratch: nothing in here outlives the frame.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "firmware/recon/observe/frame_queue.hpp"
#include "firmware/recon/observe/observation.hpp"
#include "firmware/recon/observe/occlusion.hpp"
#include "firmware/recon/track/assignment.hpp"
#include "firmware/recon/track/correspondence.hpp"
#include "firmware/recon/track/object.hpp"
#include "firmware/recon/track/pieces.hpp"
#include "hal/base/fixed.hpp"

namespace fencepost::recon {

/// Called in this order for each frame: predict, observe, match. Then its results are valid; the object table calls
/// begin() and end() for objects that begin or end in the same frame.
template <class ObjectType, std::size_t kObjects>
class Matcher {
 public:
  using Objects = std::array<ObjectType, kObjects>;

  /// Predicts each object's place in the image. `place_of(object, slot, is_alone)`: its place in its local frame, if a
  /// better one than that of its models is known; `is_alone()` of its colour. `stands_since`: see Standing.
  template <class PlaceOf>
  [[gnu::noinline]] void predict(const Objects& objects, base::Time exposure, base::Time stands_since,
                                 const CameraModel& camera, const LensPose& lens, const MeasurementNoise& noise,
                                 const PlaceOf& place_of) {
    std::fill_n(predictions_.begin(), slots_, Prediction{});
    std::fill_n(blob_of_.begin(), slots_, kNoMatch);
    slots_ = base::slots_in_use(objects);
    for (std::size_t o = 0; o < slots_; ++o) {
      if (!objects[o].used()) continue;
      const auto alone = [&] { return is_alone(objects, o); };
      const std::optional<CylinderEstimate> place = place_of(objects[o], o, alone);
      predictions_[o] = predict_one(objects[o], camera, lens, place, noise);
      const bool lost = place && exposure - objects[o].last_seen >= kMoment;
      if (predictions_[o].anywhere && !(lost && alone())) predictions_[o].possible = false;
      predictions_[o].signature = objects[o].signature;
      predictions_[o].confirmed = objects[o].confirmed;
      predictions_[o].hides = objects[o].confirmed && !objects[o].cylinder.only_bearings();
      predictions_[o].refuted = objects[o].refuted();
      predictions_[o].last_track = objects[o].last_track;
      const bool from_here = objects[o].last_seen > stands_since && !objects[o].moving;
      predictions_[o].foot_row = from_here ? objects[o].foot_row : std::int16_t{0};
    }
  }

  /// Blobs of `frame` that are pieces of one object become one, in place. Objects that turn out to be two are marked as
  /// divided.
  [[gnu::noinline]] void observe(WaitingFrame& frame, const CameraModel& camera, const Objects& objects) {
    recon::observe(frame.blobs.view(), camera, observations_);
    in_pieces_.fill(false);
    const auto find = [&] { return find_pieces(observations_.view(), std::span(predictions_).first(slots_)); };
    for (PiecePair pair = find(); pair.found; pair = find()) {  // each time a blob or an object less
      if (pair.whole != kNoMatch) {
        in_pieces_[pair.whole] = true;
        if (objects[pair.whole].in_pieces >= kFewestViews || !pair.rows_match) {
          divide(predictions_[pair.whole]);
          continue;
        }
      }
      join(frame.blobs, pair);
      recon::observe(frame.blobs.view(), camera, observations_);
    }
  }

  /// `width_of`: of things of a signature, mm; 0: not known.
  template <class WidthOf>
  void tell_widths(const WidthOf& width_of) {
    for (Observation& seen : observations_) seen.width = width_of(seen.signature);
  }

  /// The number of blobs that are objects known before. `id_cost`: see IdEvidence.
  [[gnu::noinline]] std::uint16_t match(std::uint8_t id_cost) {
    const std::size_t blobs = observations_.size();
    weigh_pairs(id_cost);
    assign<kObjects>(costs_, slots_, {object_of_.data(), blobs});
    std::uint16_t matched = 0;
    for (std::size_t b = 0; b < blobs; ++b) {
      if (object_of_[b] == kNoMatch) continue;
      blob_of_[object_of_[b]] = static_cast<std::uint8_t>(b);
      ++matched;
    }
    share_merged();
    hide_behind_models();
    return matched;
  }

  /// The observation of the object in this slot, which must be seen. In a blob that two objects share, the other's ends
  /// and rows are occluded, and the id may be the other's.
  [[nodiscard]] Observation observation_of(std::size_t o) const {
    Observation observation = observations_[blob_of_[o]];
    if (!shared_[o].any) return observation;
    (shared_[o].is_right ? observation.left : observation.right) = End::kOccluded;
    observation.top = End::kOccluded;
    observation.track = predictions_[o].last_track & kMaxTrack;
    if (shared_[o].is_farther) observation.bottom = End::kOccluded;
    return observation;
  }

  /// True if something in the image may occlude the object, as predicted.
  [[nodiscard]] bool may_be_hidden(std::size_t o) const {
    for (const Observation& seen : observations_) {
      if (overlaps(predictions_[o], seen) && !stands_behind(seen, predictions_[o])) return true;
    }
    return false;
  }

  /// The object that is two now, if the blob is a good part of it.
  [[nodiscard]] const Prediction* divided_at(const Observation& seen) const {
    for (const Prediction& whole : std::span(predictions_).first(slots_)) {
      const bool part = whole.divided && whole.signature == seen.signature && has_middle_of(whole, seen);
      if (part && 3 * seen.columns() >= whole.right.at - whole.left.at) return &whole;
    }
    return nullptr;
  }

  /// The slot of the object of which a leftover blob may be a further piece; kObjects: none. The piece is inside the
  /// object's interval on the same foot, or it is alike and close beside the object's blob. A piece that stays beside
  /// it for kFewestViews no longer counts.
  [[nodiscard]] std::size_t piece_of(const Objects& objects, std::size_t b) const {
    for (std::size_t o = 0; o < slots_; ++o) {
      if (!may_be_piece(o, b)) continue;
      const int step = taken_by(o).box.y2 - observations_[b].box.y2;
      const bool inside = covers(predictions_[o], observations_[b]) && step <= kTouchPixels && step >= -kTouchPixels;
      if (inside || (alike(o, b) && objects[o].in_pieces < kFewestViews)) return o;
    }
    return kObjects;
  }
  /// Objects up to this slot whose blob has a leftover one like itself beside it are in pieces in this frame.
  void count_as_pieces(std::size_t b, std::size_t last) {
    for (std::size_t o = 0; o < slots_ && o <= last; ++o) {
      if (may_be_piece(o, b) && alike(o, b)) in_pieces_[o] = true;
    }
  }

  void begin(std::size_t o, std::size_t b) {
    slots_ = std::max(slots_, o + 1);
    blob_of_[o] = static_cast<std::uint8_t>(b);
    object_of_[b] = static_cast<std::uint8_t>(o);
    shared_[o] = {};
    in_pieces_[o] = false;
  }
  void end(std::size_t o) {
    in_pieces_[o] = false;
    if (blob_of_[o] == kNoMatch) return;
    if (object_of_[blob_of_[o]] == o) object_of_[blob_of_[o]] = kNoMatch;
    blob_of_[o] = kNoMatch;
  }

  /// The number of slots up to the last object of this frame.
  [[nodiscard]] std::size_t slots() const { return slots_; }
  [[nodiscard]] std::span<const Observation> observations() const { return observations_.view(); }
  [[nodiscard]] std::uint8_t blob_of(std::size_t o) const { return blob_of_[o]; }
  [[nodiscard]] bool seen(std::size_t o) const { return blob_of_[o] != kNoMatch; }
  /// True if the object's blob is another object's, too.
  [[nodiscard]] bool shares(std::size_t o) const { return shared_[o].any; }
  [[nodiscard]] bool taken(std::size_t b) const { return object_of_[b] != kNoMatch; }
  [[nodiscard]] bool in_pieces(std::size_t o) const { return in_pieces_[o]; }
  [[nodiscard]] const Prediction& prediction(std::size_t o) const { return predictions_[o]; }
  /// Row of the lower border of the object's blob: of two objects on the floor the nearer one's is lower in the image.
  [[nodiscard]] std::int16_t foot_of(std::size_t o) const { return taken_by(o).box.y2; }

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

  // No other object has its colour.
  [[nodiscard]] bool is_alone(const Objects& objects, std::size_t o) const {
    const auto in_use = std::span(objects).first(slots_);
    return std::none_of(in_use.begin(), in_use.end(), [&](const ObjectType& other) {
      return other.used() && other.signature == objects[o].signature && other.id != objects[o].id;
    });
  }

  // The object turned out to be two that were never apart in the image before: nothing matches it any more.
  static void divide(Prediction& prediction) {
    prediction.divided = true;
    prediction.possible = false;
    prediction.depth = 0;
  }

  void weigh_pairs(std::uint8_t id_cost) {
    const std::size_t blobs = observations_.size();
    for (std::size_t o = 0; o < slots_; ++o) {
      for (std::size_t b = 0; b < blobs; ++b) {
        // A blob without an edge of its own fits anything before it, so its foot decides.
        const Prediction& object = predictions_[o];
        const Observation& seen = observations_[b];
        const bool background = seen.no_edge() && stands_behind(seen, object);
        const bool may =
            object.possible && object.signature == seen.signature && !background && !stands_elsewhere(object, seen);
        const std::uint8_t cost = may ? match_cost(object, seen) : kImpossible;
        costs_[o * blobs + b] = cost_with_ids(cost, object.last_track, seen.track, id_cost);
      }
    }
  }

  // A blob of two objects that touch in the image gives each of them its outer end.
  void share_merged() {
    shared_.fill(Shared{});
    for (std::size_t b = 0; b < observations_.size(); ++b) {
      const std::uint8_t signature = observations_[b].signature;
      for (std::size_t left = 0; left < slots_; ++left) {
        if (predictions_[left].signature != signature) continue;
        for (std::size_t right = 0; right < slots_; ++right) {
          if (predictions_[right].signature == signature && may_share(left, right, b)) share(left, right, b);
        }
      }
    }
  }

  // A nearer object hides an end although its own blob is cut short or was not delivered.
  void hide_behind_models() {
    for (std::size_t b = 0; b < observations_.size(); ++b) {
      if (object_of_[b] == kNoMatch || shared_[object_of_[b]].any) continue;
      const Prediction& own = predictions_[object_of_[b]];
      Observation& seen = observations_[b];
      for (std::size_t o = 0; o < slots_; ++o) {
        if (o == object_of_[b] || !may_hide(o)) continue;
        if (hides_end(predictions_[o], own, seen.left_column, -1)) seen.left = End::kLowerBound;
        if (hides_end(predictions_[o], own, seen.right_column, 1)) seen.right = End::kLowerBound;
      }
    }
  }

  // With a wrong pose much seems to be in the way. Were all of it to hide ends, nothing could correct the pose.
  [[nodiscard]] bool may_hide(std::size_t o) const {
    const Prediction& nearer = predictions_[o];
    return nearer.hides && (seen(o) || (nearer.possible && !nearer.refuted));
  }

  // All three of one signature.
  [[nodiscard]] bool may_share(std::size_t left, std::size_t right, std::size_t b) const {
    if (left == right) return false;
    const std::uint8_t taken = object_of_[b];
    const auto unseen = [&](std::size_t o) { return blob_of_[o] == kNoMatch && !shared_[o].any; };
    const bool one_has_it = (taken == left && unseen(right)) || (taken == right && unseen(left));
    if (!one_has_it && !(taken == kNoMatch && unseen(left) && unseen(right))) return false;
    return shows_both(predictions_[left], predictions_[right], observations_[b]);
  }
  void share(std::size_t left, std::size_t right, std::size_t b) {
    const float left_depth = predictions_[left].depth, right_depth = predictions_[right].depth;
    const bool left_is_nearer = left_depth > 0 && (!(right_depth > 0) || left_depth < right_depth);
    shared_[left] = {true, false, !left_is_nearer};
    shared_[right] = {true, true, left_is_nearer};
    blob_of_[left] = blob_of_[right] = static_cast<std::uint8_t>(b);
    object_of_[b] = static_cast<std::uint8_t>(left);
  }

  [[nodiscard]] const Observation& taken_by(std::size_t o) const { return observations_[blob_of_[o]]; }
  [[nodiscard]] bool may_be_piece(std::size_t o, std::size_t b) const {
    return seen(o) && taken_by(o).signature == observations_[b].signature;
  }
  [[nodiscard]] bool alike(std::size_t o, std::size_t b) const { return are_alike(taken_by(o), observations_[b]); }

  std::size_t slots_ = kObjects;  ///< up to the last object; behind them nothing is predicted or seen
  std::array<Prediction, kObjects> predictions_{};
  Observations observations_;
  std::array<std::uint8_t, kObjects * sensor::kMaxBlobs> costs_{};  ///< [object][blob], as many columns as blobs
  std::array<std::uint8_t, kObjects> blob_of_{};
  std::array<Shared, kObjects> shared_{};
  std::array<bool, kObjects> in_pieces_{};
  std::array<std::uint8_t, sensor::kMaxBlobs> object_of_{};
};

}  // namespace fencepost::recon
