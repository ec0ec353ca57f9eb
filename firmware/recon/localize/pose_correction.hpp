// The map's objects as landmarks of the pose: which of them are in the filter, what a sighting tells it, and what a
// better pose does to the map.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "firmware/recon/localize/landmark_filter.hpp"
#include "firmware/recon/localize/tuning.hpp"
#include "firmware/recon/track/object.hpp"
#include "firmware/recon/track/object_events.hpp"

namespace fencepost::recon {

/// What the filter is told of an object that becomes a landmark.
/// Its cylinder, where rows have told how far it is; else the row's depth or a typical size
/// tell how far it may be on the bearing of `seen`, from the corrected pose. Radius 0: nothing does.
LandmarkGuess guess_of(const ObjectCore& object, const Sighting& seen, const MeasurementNoise& noise);

/// What a sighting tells the filter of a landmark, at most three equations in the robot frame.
struct SightedCircle {
  struct Line {
    CircleEquation equation;
    float variance = 0;  ///< m^2; 0: there is none
  };
  std::array<Line, 3> lines;
};

/// Both ends give the width, which no wrong heading changes, and the middle, which the radius does not change; a single
/// end gives its tangent, the foot one more. `seen` from the robot; by the estimate the circle of this `radius` (m) is
/// `away` from the lens, robot frame; `novelty` of the view.
SightedCircle sighted_circle(const Sighting& seen, const Vec2& away, float radius, float novelty,
                             const MeasurementNoise& noise);

/// Slot i of the filter is slot i of the map's table: an object that was seen kViewsForLandmark times, and whose
/// distance can at least be guessed, is a landmark until it ends, moves or its models begin again.
template <class Profile>
class PoseCorrection {
 public:
  static constexpr std::size_t kLandmarks = Profile::kObjects;

  /// A new run: the map frame is that of the odometry.
  void clear() {
    running_ = false;
    filter_.view().at = {};
  }

  /// The robot has moved; where it is now. `drift`: by what share of the distance odometry may be off, 0 switches the
  /// correction off. What was corrected so far stays then: the map is where it is.
  MapPose drive(const MapPose& odometry, float drift) {
    const bool on = drift > 0;
    if (on && !running_) {
      const FilterView filter = filter_.view();
      filter.at = {recon::corrected(filter.at, odometry), odometry};
      start(filter);
    }
    running_ = on;
    if (running_) drive_to(filter_.view(), odometry, drift_noise(drift));
    return corrected(odometry);
  }

  [[nodiscard]] bool running() const { return running_; }
  [[nodiscard]] MapPose corrected(const MapPose& odometry) const { return recon::corrected(filter_.at(), odometry); }
  [[nodiscard]] const LandmarkFilter<kLandmarks>& filter() const { return filter_; }
  /// At the last frame.
  [[nodiscard]] const MapPose& pose() const { return filter_.at().pose; }
  [[nodiscard]] PoseSigma sigma() const { return pose_sigma(filter_.pose_covariances()); }

  /// For matching: where the object in `slot` is, in its local frame, if it is a landmark. Of that the filter knows how
  /// far the pose has drifted away since it was seen, which closes the loop.
  [[nodiscard]] std::optional<CylinderEstimate> place_of(const ObjectCore& object, std::size_t slot) {
    if (!running_ || !filter_.landmark(slot).used()) return std::nullopt;
    CylinderEstimate place = seen_from_robot(filter_.view(), slot);
    place.center += offset_from(object.origin, pose().position);
    return place;
  }
  [[nodiscard]] MeasurementNoise model_noise(MeasurementNoise noise) const {
    if (!running_) return noise;
    noise.heading = std::max(noise.heading, kCorrectedHeading);
    noise.position = std::max(noise.position, kCorrectedPosition);
    return noise;
  }

  /// Takes the frame's sightings of landmarks, on a small part of Profile::kModelTurns of them, in turn. Objects move
  /// with their landmarks. The pose that comes of it; `driven` as long as nothing is corrected.
  template <class Objects, class Matcher>
  [[gnu::noinline]] MapPose correct(const MapPose& driven, Objects& objects, const Matcher& matcher,
                                    const CameraModel& camera, const MeasurementNoise& noise) {
    if (!running_) return driven;
    std::size_t turns = 0;
    for (std::size_t i = 0; i < kLandmarks && turns < Profile::kModelTurns; ++i) {
      next_ = static_cast<std::uint8_t>(next_ + 1U < kLandmarks ? next_ + 1U : 0U);
      if (!filter_.landmark(next_).used() || !matcher.seen(next_)) continue;
      if (matcher.observation_of(next_).moves) continue;
      const Sighting seen = make_sighting(camera, {{}, camera.position, camera.yaw}, matcher.observation_of(next_));
      apply(objects, next_, seen, lens_pose(pose(), camera), noise);
      ++turns;
    }
    return filter_.at().pose;
  }

  /// The map has changed: forgets the landmarks whose objects have ended or moved, adds what can be a landmark now.
  template <class Table, class Matcher>
  void follow(const Table& table, const Matcher& matcher, const CameraModel& camera, const MeasurementNoise& noise) {
    if (!running_) return;
    for (const ObjectEvent& event : table.events()) {
      if (event.kind != EventKind::kBorn && filter_.landmark(event.slot).used()) {
        forget_landmark(filter_.view(), event.slot);
      }
    }
    for (std::size_t o = 0; o < kLandmarks; ++o) {
      const ObjectCore& object = table.objects()[o];
      const bool may_be = object.used() && !object.moving && object.views >= kViewsForLandmark;
      if (filter_.landmark(o).used() || !may_be || !matcher.seen(o)) continue;
      const Sighting seen = make_sighting(camera, lens_pose(pose(), camera), matcher.observation_of(o));
      const LandmarkGuess guess = guess_of(object, seen, noise);
      if (guess.radius > 0) add_landmark(filter_.view(), o, guess);
    }
  }

 private:
  // `seen` from the robot: its anchor is the robot frame's origin. `lens`: in the map.
  template <class Objects>
  void apply(Objects& objects, std::size_t slot, const Sighting& seen, const LensPose& lens,
             const MeasurementNoise& noise) {
    const Landmark& landmark = filter_.landmark(slot);
    const Vec2 from_lens = -lens.lens_from(landmark.center);
    const Vec2 away = rotated(seen.axis, to_camera(lens, from_lens));
    // While the robot stands its shape error is the same in every view, so it counts as little as the view is novel.
    const float novelty = objects[slot].novelty(lens.lens_from(objects[slot].origin));
    const SightedCircle circle = sighted_circle(seen, away, landmark.radius, novelty, noise);
    for (const SightedCircle::Line& line : circle.lines) {
      if (!(line.variance > 0)) continue;
      std::array<float, LandmarkFilter<kLandmarks>::kStates> step{};
      if (correct_by(filter_.view(), slot, line.equation, line.variance, step) == TangentFate::kUsed)
        move(objects, slot, step);
    }
  }

  // How the landmark that was seen moves against the pose, its object's models find out for themselves.
  template <class Objects>
  void move(Objects& objects, std::size_t seen, std::span<const float> step) {
    for (std::size_t o = 0; o < kLandmarks; ++o) {
      if (o != seen && filter_.landmark(o).used()) objects[o].shift({step[3 + 2 * o], step[4 + 2 * o]});
    }
  }

  LandmarkFilter<kLandmarks> filter_;
  std::uint8_t next_ = 0;  ///< whose turn it was
  bool running_ = false;
};

}  // namespace fencepost::recon
