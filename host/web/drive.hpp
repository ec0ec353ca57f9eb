// A robot that somebody drives through a scene: the simulator's sensors, the robot's loop, and the log of both.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/geometry/planar.hpp"
#include "host/replay/replay.hpp"
#include "host/scene/scene.hpp"
#include "host/simulate/simulation.hpp"
#include "host/web/live_log.hpp"

namespace fencepost::host {

/// The map's errors against the true footprints.
struct MapScore {
  std::optional<double> recklessness;  ///< share of the true footprints that the map does not enclose
  std::optional<double> paranoia;      ///< share of the map where nothing stands; nothing of a map without area
};
/// Scores all outlines of the hybrid but tentative ones, against the footprints at `t` that the camera can report.
MapScore map_score(const std::vector<ObjectResult>& objects, const Scene& scene, double t);
std::string to_json(const MapScore& score);

class Drive {
 public:
  static constexpr double kSpeed = 0.4;  ///< m/s, at full speed
  static constexpr double kTurn = 1.5;   ///< rad/s

  /// The robot stands where the scene's path begins, or at the origin. The log has this scene's camera to the end.
  explicit Drive(Scene scene);
  Drive(const Drive&) = delete;
  Drive& operator=(const Drive&) = delete;

  /// The world is another one from now on: objects, noise, the true camera. Its signatures stay.
  void change(Scene scene);
  /// Shares of full speed, -1 to 1: forwards, to the left.
  void steer(double forward, double turn);
  /// While a STOP is in force, it does not drive forwards.
  void obey(bool stops) { obeys_ = stops; }
  /// Drives on by whole samples of odometry, as many as fit. False: the run has ended.
  bool advance(double seconds);
  /// The log has ended: frames that still wait are counted.
  void finish() { live_.finish(); }

  [[nodiscard]] LiveLog& live() { return live_; }
  [[nodiscard]] const PageReplay& page() const { return live_.page(); }
  [[nodiscard]] const std::string& log() const { return live_.text(); }
  /// The truth behind it, as JSON: its true pose, its speed, how often it bumped into something.
  [[nodiscard]] std::string truth() const;
  /// `map_score` of now, as JSON. Cost: some ms where many things are around.
  [[nodiscard]] std::string score() const;

 private:
  [[nodiscard]] TimedPose start() const;
  void write_body();
  void accelerate(double seconds);
  [[nodiscard]] bool touches(const TimedPose& pose) const;
  void move(double seconds);

  Scene scene_;
  LiveLog live_;
  std::vector<TimedPose> knots_;  ///< the true way, as long as a late frame may ask for it
  LinearRing body_;               ///< robot frame
  TruthSink nobody_;
  LineSink written_;
  std::optional<Simulation> simulation_;
  double forward_ = 0;
  double turn_ = 0;
  double speed_ = 0;      ///< m/s
  double turn_rate_ = 0;  ///< rad/s
  double owed_ = 0;       ///< s, less than a sample
  bool obeys_ = true;
  bool held_ = false;  ///< a STOP keeps it from driving forwards
  int bumps_ = 0;
  std::optional<TimedPose> bumped_;  ///< where it was at the last one, until it has left there
};

}  // namespace fencepost::host
