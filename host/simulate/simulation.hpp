// One run of one scene, a sample of odometry at a time.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "host/scene/scene.hpp"
#include "host/simulate/car_odometer.hpp"
#include "host/simulate/odometer.hpp"
#include "host/simulate/optics.hpp"
#include "host/simulate/render.hpp"
#include "host/simulate/simulate.hpp"
#include "host/simulate/trajectory.hpp"
#include "host/simulate/truth.hpp"
#include "host/simulate/world.hpp"

namespace fencepost::host {

using TruthSink = std::function<void(const FrameTruth&)>;

class Simulation {
 public:
  /// `scene` and the sinks must outlive this. The scene may change between two steps, then `scene_changed` is due.
  Simulation(const Scene& scene, Trajectory trajectory, const LineSink& sink, const TruthSink& truth);

  /// Header and calibration. The calibration stays as it is here, whatever the scene becomes.
  void begin();
  /// The frames that have arrived, and the next sample. False: the run is over, by its path, by `ended`, or because a
  /// value was outside the range of its record.
  bool step(const std::function<bool(double t)>& ended = {});
  /// All of it. False: a value was outside the range of its record.
  bool run(const std::function<bool(double t)>& ended = {});
  /// Objects are elsewhere, or the true camera is another one.
  void scene_changed();

  [[nodiscard]] const SimulationSummary& summary() const { return summary_; }

 private:
  struct Exposure {
    std::uint64_t number = 0;
    base::Time exposed;
    base::Time arrives;
  };

  void list_next_exposure();
  template <class Record>
  void write(const Record& record);
  void write_calibration();
  void write_car();
  void write_frame(const Exposure& exposure);
  [[nodiscard]] CameraPose camera_at(const TimedPose& robot) const;

  const Scene& scene_;
  const sensor::CameraIntrinsics written_;  ///< the camera as the robot knows it
  const LineSink& sink_;
  const TruthSink& truth_;
  Trajectory trajectory_;
  std::optional<World> world_;
  Odometer odometer_;
  CarOdometer car_;
  sensor::CameraIntrinsics rendered_;  ///< by rays_ and image_
  double pitch_;                       ///< likewise
  PixelRays rays_;
  LabelImage image_;
  base::Time t_{0};  ///< of the next sample
  base::Time repeat_;
  int listed_ = 0;  ///< exposures, dropped ones too
  std::optional<Exposure> next_;
  base::Time previous_{-1};  ///< arrival
  base::Time end_{0};        ///< of all exposures listed
  SimulationSummary summary_;
  bool in_range_ = true;
};

}  // namespace fencepost::host
