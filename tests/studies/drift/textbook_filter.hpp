// EKF SLAM as in textbooks, run over a log: the pose and all landmarks, each known by its signature.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "host/geometry/polygon.hpp"
#include "host/scene/scene.hpp"

namespace fencepost::test {

/// EKF SLAM with known correspondences, full covariance and one gate (Thrun, Burgard, Fox, Probabilistic
/// Robotics, 10.2). Metres and radians; the frame is that of the first pose. At most 31 landmarks.
class TextbookFilter {
 public:
  /// A step of odometry in the robot's frame before it: forward, to the left, turned.
  void move(double forward, double left, double turn);
  /// From the robot to the landmark's middle. One that was never seen with its range is not known.
  void see(std::uint8_t signature, double bearing, std::optional<double> range);
  /// Time is zero.
  [[nodiscard]] host::TimedPose pose() const { return {0, state_(0), state_(1), state_(2)}; }
  /// By signature.
  [[nodiscard]] std::map<std::uint8_t, host::Point> landmarks() const;

 private:
  static constexpr int kMaxStates = 3 + 2 * 31;
  using State = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxStates, 1>;
  using Covariance = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxStates, kMaxStates>;

  void begin(std::uint8_t signature, double bearing, double range);

  State state_ = State::Zero(3);
  Covariance covariance_ = Covariance::Zero(3, 3);
  std::map<std::uint8_t, int> places_;  ///< of landmarks in the state
  std::map<std::uint8_t, int> missed_;  ///< times in a row beyond the gate
};

/// The results of a log.
struct TextbookRun {
  std::map<std::uint8_t, host::Point> landmarks;  ///< by signature
  std::vector<host::TimedPose> path;              ///< at each frame, before it corrects
};

/// Reads a whole log whose boxes have ground rows. `radius`: of all landmarks, m. Boxes of the signature `unknown` are
/// left out. Throws std::runtime_error where the log cannot be read.
TextbookRun run_textbook(const std::string& log, double radius, std::uint8_t unknown = 0);

}  // namespace fencepost::test
