// The odometry of a log as a function of time.
#pragma once

#include <vector>

#include "host/geometry/median.hpp"
#include "host/replay/pose_noise.hpp"
#include "host/scene/scene.hpp"

namespace fencepost::host {

/// A reported pose, and the signed way up to it (backwards counts against it), m.
struct TrackPose {
  double x = 0;
  double y = 0;
  double heading = 0;  ///< rad, continuous
  double way = 0;
};

class OdometryTrack {
 public:
  /// `samples` by time, at least two; headings may be wrapped.
  explicit OdometryTrack(std::vector<TimedPose> samples);

  /// Interpolated; before the first sample the first, after the last the last.
  [[nodiscard]] TrackPose at(double t) const;
  /// Per second: the mean of a tenth of a second, so that steps of the odometry's own do not count.
  [[nodiscard]] TrackPose rate(double t) const;
  /// The white noise of single samples that remains after smoothing.
  [[nodiscard]] const PoseNoise& white() const { return white_; }

  [[nodiscard]] double begin() const { return samples_.front().t; }
  [[nodiscard]] double end() const { return samples_.back().t; }
  /// m and rad, each turn and way counted as positive.
  [[nodiscard]] double driven() const { return driven_; }
  [[nodiscard]] double turned() const { return turned_; }

 private:
  void smooth();
  void measure_noise();
  void add_up();

  std::vector<TimedPose> samples_;
  std::vector<double> way_;
  PoseNoise white_;
  double driven_ = 0;
  double turned_ = 0;
};

}  // namespace fencepost::host
