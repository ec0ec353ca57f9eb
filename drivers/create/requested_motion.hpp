// The pose of a Create 1, which has no wheel counts.
#pragma once

#include <cstdint>

#include "drivers/odometry/arc_integrator.hpp"
#include "hal/base/units.hpp"
#include "hal/sensor/odometry.hpp"

namespace fencepost::create {

/// A Create 1 tells the wheel speeds that were requested of it, and its distance and angle since they were last read,
/// in whole mm and degrees: what a reading cuts off is lost. Read with each frame, a turn of less than 67 degrees/s is
/// never told. So the requested speeds are integrated, and distance and angle are read seldom, when a second's motion
/// is many times what is cut off: a prediction that lies within what a reading can mean stands, any other gives way to
/// the reading's middle. A robot that is pushed, stalls or slips is then read more often.
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
    bool in_part = false;  ///< it may lack what an earlier one told: then it can only add to what was predicted
  };
  void read(const Reading& reading);
  /// It says nothing: what was predicted stands.
  void skip_reading();

  /// Until the next reading.
  [[nodiscard]] base::Duration interval() const { return surprised_ ? kSurprised : kUsual; }
  [[nodiscard]] sensor::OdometrySample sample(base::Time t) const { return pose_.sample(t); }
  /// Readings by which the robot had not moved as requested.
  [[nodiscard]] std::uint32_t surprises() const { return surprises_; }

  /// Chosen on a model of the robot (README.md): 0.25, 0.5, 1 and 2 s were compared.
  static constexpr base::Duration kUsual = base::milliseconds(1'000);
  static constexpr base::Duration kSurprised = base::milliseconds(250);
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
