// The pose of a Create 1, which has no wheel counts.
#pragma once

#include <cstdint>

#include "drivers/odometry/arc_integrator.hpp"
#include "hal/base/units.hpp"
#include "hal/sensor/odometry.hpp"

namespace fencepost::create {

/// A Create 1 reports the requested wheel speeds, and its distance and angle since they were last read. These are whole
/// mm and degrees, and each reading loses the fraction. Read with each frame, a turn of less than 67 degrees/s would
/// always read 0. So the requested speeds are integrated. Distance and angle are read only when a second's motion is
/// many times the fraction. A prediction within the range that a reading allows is kept; any other is replaced by the
/// middle of that range. A robot that is pushed, stalls or slips is then read more often.
class RequestedMotion {
 public:
  /// `track_pm` between the wheels; positive.
  explicit RequestedMotion(std::int64_t track_pm);

  /// mm/s, as requested at t; t increases. Between two calls the wheels have their mean, for kLongestStep at most.
  void request(std::int32_t left, std::int32_t right, base::Time t);

  /// Whole mm and degrees since the last reading, at the time of the last request.
  struct Reading {
    std::int32_t mm = 0;
    std::int32_t degrees = 0;
    bool in_part = false;  ///< it may lack an earlier reading's part: then it can only add to the prediction
  };
  void read(const Reading& reading);
  /// Drops the reading and keeps the prediction.
  void skip_reading();

  /// Until the next reading.
  [[nodiscard]] base::Duration interval() const { return surprised_ ? kSurprised : kUsual; }
  [[nodiscard]] sensor::OdometrySample sample(base::Time t) const { return pose_.sample(t); }
  /// Readings by which the robot had not moved as requested.
  [[nodiscard]] std::uint32_t surprises() const { return surprises_; }

  /// Interval of readings. Chosen on a model of the robot (README.md): 0.25, 0.5, 1 and 2 s were compared.
  static constexpr base::Duration kUsual = base::milliseconds(1'000);
  /// The interval after a reading that contradicted the requests.
  static constexpr base::Duration kSurprised = base::milliseconds(250);
  /// Maximum time between two requests over which motion is integrated.
  static constexpr base::Duration kLongestStep = base::milliseconds(100);

 private:
  void advance(std::int64_t way);
  [[nodiscard]] std::int64_t heading_urad() const;

  std::int64_t track_;  ///< 0.1 um, which is mm/s times 0.1 ms
  odometry::ArcIntegrator pose_;
  bool any_ = false;
  bool surprised_ = false;
  std::int32_t left_ = 0;
  std::int32_t right_ = 0;
  base::Time t_;
  std::int64_t lead_ = 0;            ///< of the right wheel over the left one, twice 0.1 um
  std::int64_t corrected_urad_ = 0;  ///< by readings, all together
  std::int64_t way_ = 0;             ///< since the last reading, 0.1 um
  std::int64_t heading_at_reading_ = 0;
  std::uint32_t surprises_ = 0;
};

}  // namespace fencepost::create
