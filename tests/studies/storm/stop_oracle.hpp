// Things that a robot must have known from its loop's inputs alone: places where feet of blobs were seen again and
// again. It is simple on purpose, and careful: it asks for a stop only well inside of every limit.
#pragma once

#include <deque>
#include <optional>
#include <string>

#include "firmware/config/settings.hpp"
#include "hal/sensor/blob_frame.hpp"
#include "hal/sensor/camera.hpp"
#include "hal/sensor/odometry.hpp"

namespace fencepost::test {

class StopOracle {
 public:
  /// Inputs that the loop used, in order.
  void take(const sensor::OdometrySample& sample);
  void take(const sensor::BlobFrame& frame, const sensor::CameraIntrinsics& camera);
  /// A new run.
  void forget() { *this = {}; }

  /// For how long a stop has been due: the robot drives towards something known that is near in front of it. what()
  /// names it.
  [[nodiscard]] base::Duration overdue(const config::Settings& settings, base::Time now);
  [[nodiscard]] const std::string& what() const { return what_; }

 private:
  struct Seen {
    base::Time t;
    std::uint32_t frame = 0;
    double x = 0;  ///< m, odometry's frame
    double y = 0;
  };
  struct Waiting {
    sensor::BlobFrame frame;
    sensor::CameraIntrinsics camera;
  };
  void place_frames();
  void place(const Waiting& waiting, const sensor::OdometrySample& pose);
  [[nodiscard]] std::optional<sensor::OdometrySample> pose_at(base::Time t) const;
  [[nodiscard]] bool drives_ahead() const;
  [[nodiscard]] bool known_ahead(const config::Settings& settings, base::Time now);

  std::deque<sensor::OdometrySample> poses_;
  std::deque<Waiting> waiting_;
  std::deque<Seen> seen_;
  std::optional<base::Time> since_;
  std::string what_;
};

}  // namespace fencepost::test
