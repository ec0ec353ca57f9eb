// Checks the camera's configuration. One object with a wrong depth by its rows stands on something or hides its foot.
// If most of the map's objects are wrong to the same side, the configured pitch or height is wrong. If objects do not
// turn as the wheels do, the focal length is wrong.
#pragma once

#include <optional>

#include "firmware/recon/track/object.hpp"
#include "firmware/record/records.hpp"

namespace fencepost::alert {

/// Counts the verdicts on the rows of the map's objects.
struct RowVotes {
  unsigned too_far = 0;
  unsigned too_near = 0;
  unsigned right = 0;
  float scales_too_far = 0;  ///< sums of the true depth over the depth by the rows
  float scales_too_near = 0;

  void add(const recon::ObjectCore& object);
};

/// One run's, with one calibration.
class CameraDoubt {
 public:
  /// After a frame, at t. `lens`: the configured focal length over the true one, if that is wrong. True if the result
  /// has changed. A complaint about rows lasts until more of them are right than wrong. Objects that left the map take
  /// nothing back.
  bool judge(const RowVotes& votes, std::optional<float> lens, base::Time t);
  /// Another calibration is in force from t on: nothing speaks against it yet. True as above.
  bool forget(base::Time t);

  [[nodiscard]] bool any() const { return said_.doubt != record::Doubt::kNone; }
  /// There was something to say in this run.
  [[nodiscard]] bool spoke() const { return any() || said_.t.raw != 0; }
  /// The present result.
  [[nodiscard]] const record::CalibrationDoubt& said() const { return said_; }
  /// The factor by which alerts widen their distances: 1, unless things are nearer than the calibration says.
  [[nodiscard]] float caution() const;

 private:
  bool say(record::Doubt doubt, float factor, base::Time t);

  record::CalibrationDoubt said_;
};

}  // namespace fencepost::alert
