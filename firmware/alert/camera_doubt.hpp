// Can the camera be as the robot was told? One object whose rows say a wrong depth stands on something or hides its
// foot. Most of the map's objects, all wrong to the same side, mean a wrong pitch or height; things that do not turn as
// the wheels do, a wrong focal length.
#pragma once

#include <optional>

#include "firmware/recon/track/object.hpp"
#include "firmware/record/records.hpp"

namespace fencepost::alert {

/// What the rows of the map's objects say, each of its own.
struct RowVotes {
  unsigned too_far = 0;
  unsigned too_near = 0;
  unsigned right = 0;
  float scales_too_far = 0;  ///< sums of what is true as a share of what the rows say
  float scales_too_near = 0;

  void add(const recon::ObjectCore& object);
};

/// One run's, with one calibration.
class CameraDoubt {
 public:
  /// After a frame, at t. `lens`: the focal length as told over the true one, if that is wrong. True: there is
  /// something new to say. A doubt about rows lasts until more of them are right than wrong; objects that are out of
  /// the map take nothing back.
  bool judge(const RowVotes& votes, std::optional<float> lens, base::Time t);
  /// Another calibration is in force from t on: nothing speaks against it yet. True as above.
  bool forget(base::Time t);

  [[nodiscard]] bool any() const { return said_.doubt != record::Doubt::kNone; }
  /// There was something to say in this run.
  [[nodiscard]] bool spoke() const { return any() || said_.t.raw != 0; }
  /// What is thought now.
  [[nodiscard]] const record::CalibrationDoubt& said() const { return said_; }
  /// By how much alerts have to widen their distances: 1, unless things are nearer than the calibration says.
  [[nodiscard]] float caution() const;

 private:
  bool say(record::Doubt doubt, float factor, base::Time t);

  record::CalibrationDoubt said_;
};

}  // namespace fencepost::alert
