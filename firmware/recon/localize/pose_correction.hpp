// The map's objects as landmarks of the pose. This class selects the landmarks, feeds their sightings to the filter,
// and moves the map's objects when the pose is corrected.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "firmware/recon/localize/drift_evidence.hpp"
#include "firmware/recon/localize/landmark_filter.hpp"
#include "firmware/recon/localize/strayers.hpp"
#include "firmware/recon/localize/tuning.hpp"
#include "firmware/recon/track/object.hpp"
#include "firmware/recon/track/object_events.hpp"
#include "hal/base/trig.hpp"

namespace fencepost::recon {

/// The first estimate of an object that becomes a landmark. It is the object's cylinder, where rows have measured its
/// distance. Otherwise it lies on the bearing of `seen` from the corrected pose, as far as its row, its configured
/// width or a typical size says. Radius 0: none of these gives a distance.
LandmarkGuess guess_of(const ObjectCore& object, const Sighting& seen, const MeasurementNoise& noise);

/// The equations that a sighting gives for a landmark, at most three, in the robot frame.
struct SightedCircle {
  struct Line {
    CircleEquation equation;
    float variance = 0;  ///< m^2; 0: there is none
  };
  std::array<Line, 3> lines;  ///< of width (or of the one end), middle and foot

  /// The bearing alone, from both ends.
  [[nodiscard]] const Line& middle() const { return lines[1]; }
};

/// Both ends give the width, which a wrong heading does not change, and the middle, which the radius does not change. A
/// single end gives its tangent; the foot gives one more equation. `seen`: from the robot. `away`, `radius`: the
/// estimated circle from the lens, robot frame, m. `novelty`: of the view.
SightedCircle sighted_circle(const Sighting& seen, const Vec2& away, float radius, float novelty,
                             const MeasurementNoise& noise);

/// The configuration of the pose correction.
struct CorrectionOrder {
  float drift = 0;      ///< share of the distance by which odometry may be off; 0: nothing
  bool always = false;  ///< else from when odometry is known to drift
};

/// Slot i of the filter is slot i of the map's table. An object is a landmark once kFewestViews views have shown it and
/// its distance can at least be guessed. It ends when the object ends or moves, or its models begin again.
/// Unless it always corrects, the filter runs beside the odometry, which gives the pose at first. Two conditions switch
/// poses and objects over to the filter. Odometry is kKnownSigmas sigmas from the filter's pose, and bearings alone
/// support the filter.
template <class Profile>
class PoseCorrection {
 public:
  static constexpr std::size_t kLandmarks = Profile::kObjects;
  /// A profile without time for all landmarks of a frame has none for all frames either.
  static constexpr LandmarkPace kPace = Profile::kLookTurns < kLandmarks ? kPaceOfRobots : kPaceOfDesks;

  /// A new run: the map frame is that of the odometry.
  void clear() {
    running_ = corrects_ = looks_ = false;
    next_ = looks_taken_ = 0;
    evidence_.clear();
    strayers_.clear();
    filter_.view().at = at_ = {};
  }

  /// Moves the robot to `odometry` and returns its pose. Switched off, it keeps the correction so far: the map stays
  /// where it is.
  MapPose drive(const MapPose& odometry, const CorrectionOrder& order) {
    const bool on = order.drift > 0;
    if (on && !running_) {
      const FilterView filter = filter_.view();
      filter.at = {corrected(odometry), odometry};
      start(filter);
      evidence_.clear();
    }
    running_ = on;
    guesses_ = order.always;
    corrects_ = on && (corrects_ || order.always);
    looks_ = on && has_gone(odometry, corrects_ ? kPace.corrected : kPace.believed);
    if (looks_) {
      std::array<float, LandmarkFilter<kLandmarks>::kStates> scratch{};
      drive_to(filter_.view(), odometry, drift_noise(order.drift), scratch);
    }
    if (corrects_) at_ = filter_.at();
    return corrected(odometry);
  }

  [[nodiscard]] bool running() const { return running_; }
  /// Takes the latest frame.
  [[nodiscard]] bool looks() const { return looks_; }
  /// Number of frames taken, modulo 256; the digest's parts take turns by it.
  [[nodiscard]] std::uint8_t looks_taken() const { return looks_taken_; }
  /// True since odometry is known to drift.
  [[nodiscard]] bool corrects() const { return corrects_; }
  [[nodiscard]] MapPose corrected(const MapPose& odometry) const { return recon::corrected(at_, odometry); }
  [[nodiscard]] const DriftEvidence<kLandmarks>& evidence() const { return evidence_; }
  [[nodiscard]] const Strayers<kLandmarks>& strayers() const { return strayers_; }
  [[nodiscard]] const LandmarkFilter<kLandmarks>& filter() const { return filter_; }
  /// At the last frame.
  [[nodiscard]] const MapPose& pose() const { return filter_.at().pose; }
  [[nodiscard]] PoseSigma sigma() const { return filter_.sigma(); }

  /// A frame, for place_of().
  struct Look {
    base::Time exposure;
    MapPoint position;  ///< of the pose that the models know
    Vec2 turn{1, 0};    ///< of that against the filter's
  };
  [[nodiscard]] Look look_at(base::Time exposure) const {
    Look look{exposure, {}, {1, 0}};
    if (!running_) return look;
    const MapPose believed = corrected(filter_.at().odometry);
    const base::SinCos turn = base::sincos_urad(believed.heading - pose().heading);
    look.position = believed.position;
    look.turn = {turn.cos, turn.sin};
    return look;
  }
  /// For matching: the object in `slot` by its landmark, in its local frame. The filter knows how far the pose has
  /// drifted since the object was seen, which closes the loop. `is_alone()`: the map has no other of its colour.
  /// Nothing if there is no landmark. Nothing for an object in view that agrees with its landmark either, as long as
  /// odometry gives the pose.
  template <class IsAlone>
  [[nodiscard]] std::optional<CylinderEstimate> place_of(const ObjectCore& object, std::size_t slot, const Look& look,
                                                         const IsAlone& is_alone) {
    if (!running_ || !filter_.landmark(slot).used()) return std::nullopt;
    const Vec2 away = offset_from(pose().position, filter_.landmark(slot).center);
    const Vec2 center = offset_from(object.origin, look.position) + rotated(look.turn, away);
    const bool in_view = !corrects_ && look.exposure - object.last_seen < kMoment;
    if (in_view && stands_near(object, center)) return std::nullopt;
    CylinderEstimate place = seen_from_robot(filter_.view(), slot);
    place.center = center;
    if (in_view && stands_there(object, place)) return std::nullopt;
    if (corrects_ && is_alone()) place.covariance.scale(kLongTails * kLongTails);
    return place;
  }
  [[nodiscard]] MeasurementNoise model_noise(MeasurementNoise noise) const {
    if (!corrects_) return noise;
    noise.heading = std::max(noise.heading, kCorrectedHeading);
    noise.position = std::max(noise.position, kCorrectedPosition);
    return noise;
  }

  /// Takes the frame's sightings of landmarks, on a small part of Profile::kModelTurns of them, in turn. Objects move
  /// with their landmarks. The pose that comes of it; `driven` as long as nothing is corrected.
  template <class Objects, class Matcher>
  [[gnu::noinline]] MapPose correct(const MapPose& driven, Objects& objects, const Matcher& matcher,
                                    const CameraModel& camera, const MeasurementNoise& noise) {
    if (!looks_) return driven;
    ++looks_taken_;
    const LensPose lens = lens_pose(driven, camera);
    // To detect drift, few landmarks a frame suffice; to correct the pose, take as many as there is time for.
    const std::size_t most = corrects_ ? Profile::kModelTurns : Profile::kLookTurns;
    const FilterView filter = filter_.view();
    std::size_t turns = 0;
    for (std::size_t i = 0; i < kLandmarks && turns < most; ++i) {
      next_ = static_cast<std::uint8_t>(next_ + 1U < kLandmarks ? next_ + 1U : 0U);
      if (!filter_.landmark(next_).used() || !matcher.seen(next_)) continue;
      if (matcher.observation_of(next_).moves) continue;
      const Sighting seen = make_sighting(camera, {{}, camera.position, camera.yaw}, matcher.observation_of(next_));
      // While the robot is stationary, the shape error is the same in every view, so the view counts by its novelty.
      const float novelty = objects[next_].novelty(lens.lens_from(objects[next_].origin));
      const SightedCircle circle = circle_of(next_, seen, camera, novelty, noise);
      if (!corrects_) weigh(circle.middle(), next_, objects[next_], driven);
      const float surprise = apply(filter, next_, circle);
      if (strayers_.look(next_, objects[next_].signature, surprise)) forget(next_);
      ++turns;
    }
    if (turns > 0 && knows_better_than(driven)) corrects_ = true;
    if (!corrects_) return driven;
    at_ = filter_.at();
    place(objects);
    return at_.pose;
  }

  /// The map has changed: forgets the landmarks whose objects have ended or moved, adds what can be a landmark now.
  template <class Table, class Matcher>
  void follow(const Table& table, const Matcher& matcher, const CameraModel& camera, const MeasurementNoise& noise) {
    if (!running_) return;
    for (const ObjectEvent& event : table.events()) {
      if (event.kind != EventKind::kMoved) strayers_.forget(event.slot);
      if (event.kind != EventKind::kBorn && filter_.landmark(event.slot).used()) forget(event.slot);
    }
    if (!looks_) return;
    for (std::size_t o = 0; o < matcher.slots(); ++o) {
      const ObjectCore& object = table.objects()[o];
      const bool may_be = object.used() && !object.moving && object.views >= kFewestViews;
      if (filter_.landmark(o).used() || !may_be || !matcher.seen(o)) continue;
      if (strayers_.bars(o, object.signature)) continue;
      // The guess is made with the models' pose, then rotated into the filter's heading.
      const MapPose believed = corrected(filter_.at().odometry);
      const Sighting seen = make_sighting(camera, lens_pose(believed, camera), matcher.observation_of(o));
      if (!guesses_ && !seen.rows_known && !(seen.known_radius > 0) && !seen.bearing) continue;
      LandmarkGuess guess = guess_of(object, seen, noise);
      if (!(guess.radius > 0)) continue;
      guess.away = turned(guess.away, pose().heading - believed.heading);
      add_landmark(filter_.view(), o, guess);
    }
  }

 private:
  // `seen` from the robot: its anchor is the robot frame's origin.
  [[nodiscard]] SightedCircle circle_of(std::size_t slot, const Sighting& seen, const CameraModel& camera,
                                        float novelty, const MeasurementNoise& noise) const {
    const Landmark& landmark = filter_.landmark(slot);
    const LensPose lens = lens_pose(pose(), camera);
    const Vec2 from_lens = -lens.lens_from(landmark.center);
    const Vec2 away = rotated(seen.axis, to_camera(lens, from_lens));
    return sighted_circle(seen, away, landmark.radius, novelty, noise);
  }

  void forget(std::size_t slot) {
    forget_landmark(filter_.view(), slot);
    evidence_.forget(slot);
  }

  // The largest surprise.
  float apply(const FilterView& filter, std::size_t slot, const SightedCircle& circle) {
    float surprise = 0;
    // On slow cores the range equation and the width equation alternate.
    const bool both_ends = circle.middle().variance > 0;
    const std::size_t left_out = kPace.in_turns && both_ends ? (looks_taken_ % 2U) * 2U : circle.lines.size();
    for (std::size_t i = 0; i < circle.lines.size(); ++i) {
      const SightedCircle::Line& line = circle.lines[i];
      if (!(line.variance > 0) || i == left_out) continue;
      std::array<float, LandmarkFilter<kLandmarks>::kStates> scratch{};
      static_cast<void>(correct_by(filter, slot, line.equation, line.variance, scratch, kPace.min_share));
      surprise = std::max(surprise, filter.gauge.surprise);
    }
    return surprise;
  }

  void weigh(const SightedCircle::Line& bearing, std::size_t slot, const ObjectCore& object, const MapPose& driven) {
    if (!(bearing.variance > 0)) return;
    const CylinderEstimate estimate = object.cylinder.by_edges(object.last_lens);
    if (!estimate.ok()) return;
    const Vec2 placed = offset_from(driven.position, object.origin) + estimate.center;
    const Vec2 followed = offset_from(pose().position, filter_.landmark(slot).center);
    evidence_.weigh(slot, bearing.equation, bearing.variance, turned(placed, -driven.heading),
                    turned(followed, -pose().heading));
  }

  // Residuals that are larger than expected, of lost pieces and false blobs, make the filter surer than it should be.
  [[nodiscard]] bool knows_better_than(const MapPose& driven) {
    const float usual = std::max(1.0F, filter_.gauge().usual);
    return evidence_.enough(kPace.evidence) &&
           distance_to(filter_.view(), driven) > kKnownSigmas * kKnownSigmas * usual * usual;
  }

  // So near that stands_there() holds with any variances. This is the usual case and saves computing them.
  [[nodiscard]] static bool stands_near(const ObjectCore& object, const Vec2& center) {
    const CylinderEstimate& estimate = object.cylinder.estimate();
    return estimate.ok() && (center - estimate.center).squared_norm() < 0.5F * kAcross * kAcross;
  }
  // The models have it where the filter has it, as far as either knows.
  [[nodiscard]] static bool stands_there(const ObjectCore& object, const CylinderEstimate& place) {
    const CylinderEstimate& estimate = object.cylinder.estimate();
    if (!estimate.ok()) return false;
    const Vec2 off = place.center - estimate.center;
    const float distance2 = off.squared_norm();
    // position_along(off) = distance^2 times the variance along that
    return distance2 * distance2 <= place.covariance.position_along(off) + estimate.covariance.position_along(off) +
                                        kAcross * kAcross * distance2;
  }

  // The filter looks only as often as there is something new to compare: most frames of a small robot go without.
  [[nodiscard]] bool has_gone(const MapPose& odometry, const LookInterval& interval) const {
    const MapPose& last = filter_.at().odometry;
    const std::int64_t turned = short_way(static_cast<std::int64_t>(odometry.heading) - last.heading);
    return turned > interval.turn || turned < -interval.turn ||
           offset_from(last.position, odometry.position).squared_norm() > interval.step * interval.step;
  }

  // Moves each object to its landmark. Its shape stays that of its models.
  template <class Objects>
  void place(Objects& objects) {
    for (std::size_t o = 0; o < kLandmarks; ++o) {
      const CylinderEstimate& estimate = objects[o].cylinder.estimate();
      if (!filter_.landmark(o).used() || !estimate.ok()) continue;
      objects[o].shift(offset_from(objects[o].origin, filter_.landmark(o).center) - estimate.center);
    }
  }

  LandmarkFilter<kLandmarks> filter_;
  Strayers<kLandmarks> strayers_;
  DriftEvidence<kLandmarks> evidence_;
  FilterPose at_;          ///< the last pose that was given out as corrected
  std::uint8_t next_ = 0;  ///< whose turn it was
  std::uint8_t looks_taken_ = 0;
  bool running_ = false;
  bool corrects_ = false;
  bool looks_ = false;    ///< at this frame
  bool guesses_ = false;  ///< guesses the distance of landmarks for which neither rows nor a configured width give it
};

}  // namespace fencepost::recon
