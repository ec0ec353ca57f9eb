// All objects of the map and their life cycle: born, seen, missed, confirmed, and the five ways in which one ends. Each
// frame's changes are returned as events; only this table begins or ends an object.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "firmware/recon/observe/sighting.hpp"
#include "firmware/recon/track/matcher.hpp"
#include "firmware/recon/track/object.hpp"
#include "firmware/recon/track/object_events.hpp"
#include "firmware/recon/track/tuning.hpp"
#include "hal/base/fixed.hpp"

namespace fencepost::recon {

/// k sightings in the last n frames in which the object could be seen confirm it.
struct Confirmation {
  int k = 3;
  int n = 5;
};

/// Counts of one frame's blobs.
struct FrameOutcome {
  std::uint16_t matched = 0;
  std::uint16_t born = 0;
  std::uint16_t pieces = 0;   ///< blobs that are part of an object matched already
  std::uint16_t refused = 0;  ///< blobs that might be new objects, but the table was full of confirmed ones
};

template <class Profile>
class ObjectTable {
 public:
  static constexpr std::size_t kObjects = Profile::kObjects;
  using ObjectType = Object<Profile>;
  using Objects = std::array<ObjectType, kObjects>;
  using MatcherType = Matcher<ObjectType, kObjects>;

  void clear() {
    for (ObjectType& object : objects_) object.id = 0;
    events_.clear();
    ids_ = {};
    next_id_ = 1;
    evicted_ = 0;
  }

  /// Frames come with another calibration from now on: rows are judged anew.
  void recalibrated() {
    for (ObjectType& object : objects_) object.cylinder.recalibrated();
  }

  /// `stands_since`: see Standing.
  void start_frame(base::Time exposure, base::Time stands_since) {
    stands_since_ = stands_since;
    events_.clear();
    elapsed_ = std::min(exposure - exposure_, kMissedByOneFrame);
    exposure_ = exposure;
    // A camera that lost a thing gives it another id, and its id to another thing.
    const std::size_t in_use = base::slots_in_use(objects_);
    for (std::size_t o = 0; o < in_use; ++o) {
      if (exposure_ - objects_[o].last_seen > kMoment) objects_[o].last_track = 0;
    }
  }

  /// Applies the frame's matches, from `lens`: objects seen, objects missed, and new ones.
  void update(MatcherType& matcher, const CameraModel& camera, const LensPose& lens, FrameOutcome& outcome) {
    end_divided(matcher);
    track_seen(matcher, camera, lens);
    count_missing(matcher);
    begin_new(matcher, camera, lens, outcome);
  }

  /// After the models have taken the frame: ends what is double or refuted, confirms what was seen often enough.
  void tidy(MatcherType& matcher, Confirmation confirmation) {
    count_pieces(matcher);
    end_doubles(matcher);
    end_trails(matcher);
    end_refuted(matcher);
    confirm(matcher, confirmation);
  }

  [[nodiscard]] Objects& objects() { return objects_; }
  [[nodiscard]] const Objects& objects() const { return objects_; }
  [[nodiscard]] std::span<const ObjectEvent> events() const { return events_.view(); }
  [[nodiscard]] const IdEvidence& ids() const { return ids_; }
  [[nodiscard]] base::Time exposure() const { return exposure_; }
  [[nodiscard]] std::uint32_t next_id() const { return next_id_; }
  [[nodiscard]] std::uint32_t evicted() const { return evicted_; }
  [[nodiscard]] std::uint32_t size() const {
    std::uint32_t count = 0;
    for (const ObjectType& object : objects_) count += object.used() ? 1U : 0U;
    return count;
  }

 private:
  void end_divided(MatcherType& matcher) {
    for (std::size_t o = 0; o < matcher.slots(); ++o) {
      if (matcher.prediction(o).divided) end(o, EventKind::kDivided, matcher);
    }
  }

  void track_seen(const MatcherType& matcher, const CameraModel& camera, const LensPose& lens) {
    for (std::size_t o = 0; o < matcher.slots(); ++o) {
      if (!matcher.seen(o)) continue;
      ObjectType& object = objects_[o];
      const Observation seen = matcher.observation_of(o);
      compare_ends(object, matcher.prediction(o), seen, open_ends(object, matcher.prediction(o), seen, camera, lens));
      const bool foot_jumped = compare_foot(object, seen, object.last_seen > stands_since_);
      object.weigh(!foot_jumped, elapsed_);
      // Sightings of a mover do not meet in one place.
      if (object.contradicted() || (foot_jumped && object.refuted()) || seen.moves) {
        object.restart(make_sighting(camera, lens, seen), exposure_);
        report(EventKind::kMoved, o);
      }
      object.moving = seen.moves;
      // In a box that two objects share, the object keeps its id: that says nothing.
      if (seen.track != 0 && object.last_track != 0 && !matcher.shares(o)) ids_.count(seen.track == object.last_track);
      object.last_track = seen.track;
      object.track(seen.left, seen.right, exposure_);
      object.clear = is_clear(seen.box);
      object.history.push(true);
      object.presence += kPresenceGain * (1.0F - object.presence);
    }
  }

  // The ends that were seen where none was expected, and that contradict no edge seen before.
  static EndsOff open_ends(const ObjectType& object, const Prediction& prediction, const Observation& seen,
                           const CameraModel& camera, const LensPose& lens) {
    const auto& hybrid = object.hybrid();
    // An object that reaches beyond the image, or may, has unseen sides: there the models only guess.
    const bool guessed = hybrid.large || !object.cylinder.known_whole() || !is_edge(seen.left) || !is_edge(seen.right);
    EndsOff open = ends_off(prediction, seen, guessed);
    if (!open.left && !open.right) return open;
    const Sighting sighting = make_sighting(camera, lens, seen);
    const Vec2 from = sighting.lens_from(hybrid.origin);
    open.left = open.left && !hybrid.edges_contradict(from, left_of(sighting.left.direction));
    open.right = open.right && !hybrid.edges_contradict(from, -left_of(sighting.right.direction));
    return open;
  }

  static bool is_clear(const Box& box) {
    return box.x2 - box.x1 + 1 >= kClearPixels && box.y2 - box.y1 + 1 >= kClearPixels;
  }

  void count_missing(const MatcherType& matcher) {
    for (std::size_t o = 0; o < matcher.slots(); ++o) {
      ObjectType& object = objects_[o];
      const Prediction& prediction = matcher.prediction(o);
      if (!object.used() || matcher.seen(o) || !prediction.possible) continue;
      const bool expected = prediction.expected || (object.clear && object.last_seen > stands_since_);
      if (!expected && object.confirmed) continue;
      if (matcher.may_be_hidden(o)) continue;
      object.history.push(false);
      if (!expected) continue;
      object.presence -= kPresenceGain * object.presence;
      object.weigh(false, elapsed_);
    }
  }

  void begin_new(MatcherType& matcher, const CameraModel& camera, const LensPose& lens, FrameOutcome& outcome) {
    for (std::size_t b = 0; b < matcher.observations().size(); ++b) {
      const Observation& seen = matcher.observations()[b];
      if (matcher.taken(b) || (seen.no_edge() && !seen.bearing)) continue;
      const Prediction* divided = matcher.divided_at(seen);
      if (!divided && is_piece(matcher, b)) {
        ++outcome.pieces;
        continue;
      }
      const std::size_t slot = slot_for_new(matcher);
      if (slot == kObjects) {
        ++outcome.refused;
        continue;
      }
      matcher.begin(slot, b);
      ObjectType& object = objects_[slot];
      object.begin(next_id_++, seen.signature, make_sighting(camera, lens, seen), exposure_);
      if (next_id_ == 0) next_id_ = 1;
      object.moving = seen.moves;
      object.last_track = seen.track;
      object.confirmed = divided && divided->confirmed;  // a part of a confirmed object is confirmed
      object.track(seen.left, seen.right, exposure_);
      object.history.push(true);
      report(EventKind::kBorn, slot);
      ++outcome.born;
    }
  }

  bool is_piece(MatcherType& matcher, std::size_t b) {
    const std::size_t whole = matcher.piece_of(objects_, b);
    matcher.count_as_pieces(b, whole);
    return whole < kObjects;
  }

  // Selects a free slot, else that of the least useful tentative object that this frame did not show. The order is
  // fewest views, then longest unseen, then the older id. Without one it selects the confirmed object that is longest
  // out of sight. Otherwise a robot with a small table would miss everything in new places. kObjects if all were seen
  // lately.
  std::size_t slot_for_new(MatcherType& matcher) {
    std::size_t tentative = kObjects;
    std::size_t old = kObjects;
    for (std::size_t o = 0; o < kObjects; ++o) {
      if (!objects_[o].used()) return o;
      if (matcher.seen(o)) continue;
      if (objects_[o].confirmed) {
        const bool stale = exposure_ - objects_[o].last_seen > kOutOfSight;
        if (stale && (old == kObjects || objects_[o].last_seen < objects_[old].last_seen)) old = o;
      } else if (tentative == kObjects || less_useful(objects_[o], objects_[tentative])) {
        tentative = o;
      }
    }
    const std::size_t best = tentative != kObjects ? tentative : old;
    if (best == kObjects) return best;
    ++evicted_;
    end(best, EventKind::kEvicted, matcher);
    return best;
  }
  static bool less_useful(const ObjectCore& a, const ObjectCore& b) {
    if (a.views != b.views) return a.views < b.views;
    if (a.last_seen != b.last_seen) return a.last_seen < b.last_seen;
    return a.id < b.id;
  }

  void count_pieces(const MatcherType& matcher) {
    for (std::size_t o = 0; o < matcher.slots(); ++o) {
      std::uint8_t& frames = objects_[o].in_pieces;
      if (!matcher.in_pieces(o)) frames = 0;
      if (matcher.in_pieces(o) && frames < kFewestViews) ++frames;
    }
  }

  // Solid things do not overlap: of two objects of one signature in one place, one is a double. Not when both were seen
  // in this frame.
  void end_doubles(MatcherType& matcher) {
    for (std::size_t a = 0; a < matcher.slots(); ++a) {
      for (std::size_t b = a + 1; b < matcher.slots() && objects_[a].used(); ++b) {
        if (!objects_[b].used() || objects_[a].signature != objects_[b].signature) continue;
        if (matcher.seen(a) && matcher.seen(b)) continue;
        if (!stand_in_one_place(objects_[a], objects_[b])) continue;
        const std::size_t kept = weight(objects_[a]) >= weight(objects_[b]) ? a : b;
        end(kept == a ? b : a, EventKind::kMerged, matcher, objects_[kept].id);
      }
    }
  }
  // Deletes what a mover left behind before it was known to move. Such objects have its colour and were seen shortly
  // before, few times, or are there no more.
  void end_trails(MatcherType& matcher) {
    for (std::size_t a = 0; a < matcher.slots(); ++a) {
      if (!objects_[a].used() || !objects_[a].moving || !matcher.seen(a)) continue;
      for (std::size_t b = 0; b < matcher.slots(); ++b) {
        const ObjectType& other = objects_[b];
        if (!other.used() || other.signature != objects_[a].signature || matcher.seen(b)) continue;
        const bool few = other.views < kFewViews || other.moving || other.refuted();
        if (few && exposure_ - other.last_seen < kTrail) end(b, EventKind::kMerged, matcher, objects_[a].id);
      }
    }
  }
  static float weight(const ObjectCore& object) { return object.presence * static_cast<float>(object.views); }

  // A single sighting beside a confirmed object was noise. A refuted object with few views never existed. Real cameras
  // miss better known objects in more frames than refute one: such an object stays, and only its alerts stop. What may
  // move is not where it was; a stationary robot has passed nothing.
  void end_refuted(MatcherType& matcher) {
    for (std::size_t o = 0; o < matcher.slots(); ++o) {
      const ObjectType& object = objects_[o];
      if (!object.used() || exposure_ - object.last_seen < kKeepUnseen) continue;
      const bool once = object.views == 1 && has_better_namesake(o);
      const bool refuted = object.refuted() && (object.views < kFewViews || object.may_move());
      const bool gone = object.may_move() && object.last_seen <= stands_since_ && !matcher.prediction(o).possible;
      if (once || refuted || gone) end(o, EventKind::kDeleted, matcher);
    }
  }

  [[nodiscard]] bool has_better_namesake(std::size_t o) const {
    return std::any_of(objects_.begin(), objects_.end(), [&](const ObjectType& other) {
      return other.used() && other.confirmed && other.id != objects_[o].id && other.signature == objects_[o].signature;
    });
  }

  void confirm(const MatcherType& matcher, Confirmation confirmation) {
    for (std::size_t o = 0; o < matcher.slots(); ++o) {
      ObjectType& object = objects_[o];
      const bool placed = object.used() && object.cylinder.estimate().ok();
      if (placed && object.history.seen_of_last(confirmation.n) >= confirmation.k) object.confirmed = true;
    }
  }

  // The only way in which an object ends.
  void end(std::size_t o, EventKind kind, MatcherType& matcher, std::uint32_t other = 0) {
    report(kind, o, other);
    objects_[o].id = 0;
    matcher.end(o);
  }
  void report(EventKind kind, std::size_t o, std::uint32_t other = 0) {
    static_cast<void>(events_.push_back({kind, static_cast<std::uint8_t>(o), objects_[o].id, other}));
  }

  Objects objects_{};
  ObjectEvents<kObjects> events_;
  IdEvidence ids_;
  base::Time exposure_;  ///< of the current frame
  base::Time stands_since_;
  base::Duration elapsed_;  ///< since the frame before; at most what one frame may add to an object's missing time
  std::uint32_t next_id_ = 1;
  std::uint32_t evicted_ = 0;
};

}  // namespace fencepost::recon
