// The true places of the robot's body and of the objects: distances, contacts, and those to come.
#pragma once

#include <optional>

#include "tests/studies/hazards/encounter.hpp"
#include "tests/studies/hazards/encounter_run.hpp"

namespace fencepost::test {

/// As near as this the body touches, m.
inline constexpr double kTouching = 0.005;

class Truth {
 public:
  /// `encounter` has to outlive it.
  explicit Truth(const Encounter& encounter) : encounter_(encounter) {}

  /// m from the robot's origin to the nearest point of the object at t; infinite while it is not there.
  [[nodiscard]] double distance(std::size_t object, double t, double progress) const;
  /// m from the robot's body.
  [[nodiscard]] double clearance(std::size_t object, double t, double progress) const;
  /// The body touches some object.
  [[nodiscard]] bool touches(double t, double progress) const;

 private:
  const Encounter& encounter_;
};

/// The truth of a run that was made.
class RunTruth {
 public:
  RunTruth(const Encounter& encounter, const History& history)
      : encounter_(encounter), history_(history), truth_(encounter) {}

  [[nodiscard]] double distance(std::size_t object, double t) const { return truth_.distance(object, t, progress(t)); }
  [[nodiscard]] double clearance(std::size_t object, double t) const {
    return truth_.clearance(object, t, progress(t));
  }
  /// The nearest of all objects.
  [[nodiscard]] double distance(double t) const;
  /// First time within that distance of the origin.
  [[nodiscard]] std::optional<double> first_within(std::size_t object, double metres) const;
  /// When the body touches the object first.
  [[nodiscard]] std::optional<double> contact(std::size_t object) const;
  /// The body widened by `margin` will touch it if the robot drives on at its speed from t on: how soon, s.
  [[nodiscard]] std::optional<double> meets_in(std::size_t object, double t, double margin) const;
  /// A stop at t has a reason if the body, widened by robot.margin and `grace`, will meet something near or soon. Near
  /// is within 1.5 times alert.stop of the origin, or within that less half of the default width of the body. Soon is
  /// within 1.5 times alert.ttc_stop (2.5 times, if it moves by itself).
  [[nodiscard]] bool stop_is_right(double t, double grace) const;

 private:
  [[nodiscard]] double progress(double t) const;
  template <class Is>
  [[nodiscard]] std::optional<double> first(Is is) const;

  const Encounter& encounter_;
  const History& history_;
  Truth truth_;
};

}  // namespace fencepost::test
