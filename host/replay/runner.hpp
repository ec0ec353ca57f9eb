// The robot's loop on the desk, one instance a profile, behind one interface.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "firmware/loop/memory.hpp"
#include "firmware/record/records.hpp"
#include "host/replay/pose_noise.hpp"
#include "host/replay/run_observer.hpp"
#include "host/result/result.hpp"

namespace fencepost::host {

class Runner {
 public:
  virtual ~Runner() = default;

  virtual void start_run(const record::Header& header) = 0;
  virtual void take(const sensor::CameraIntrinsics& camera) = 0;
  virtual void take(const record::Signature& signature) = 0;
  virtual void take(const record::Setting& setting) = 0;
  virtual void take(const sensor::OdometrySample& sample) = 0;
  /// Objects that were driven past so far.
  [[nodiscard]] virtual const std::vector<PassResult>& passes() const = 0;
  /// The pose that it led to; empty where it could not be used.
  virtual std::optional<sensor::OdometrySample> take(const sensor::CarSample& sample) = 0;
  virtual void take(const sensor::BlobFrame& frame) = 0;
  /// Time passed without an input up to then, if it is later than all inputs.
  virtual void take(const record::Heartbeat& beat) = 0;
  virtual void finish() = 0;
  /// Sets the pose noise from now on.
  virtual void assume(const PoseNoise& noise) = 0;
  /// From now on `observer` is called for each frame; nullptr: none.
  virtual void observe(RunObserver* observer) = 0;

  [[nodiscard]] virtual const console::Counters& counters() const = 0;
  [[nodiscard]] virtual std::uint64_t digest() const = 0;
  /// In force now.
  [[nodiscard]] virtual const config::Settings& settings() const = 0;
  /// Where the robot was in the map at a sample of odometry, by the corrections up to now.
  [[nodiscard]] virtual PoseResult pose_of(const sensor::OdometrySample& sample) const = 0;
  /// All objects with all models of the profile.
  [[nodiscard]] virtual std::vector<ObjectResult> objects() const = 0;
  /// The guard's points, which it would raise alerts for.
  [[nodiscard]] virtual std::vector<GuardPoint> guard() const = 0;
  /// The answer of `sectors` now; nothing without odometry or of a profile that has none.
  [[nodiscard]] virtual std::optional<record::SectorReport> sectors() const = 0;
  /// The answer of `ways`, likewise.
  [[nodiscard]] virtual std::optional<record::WayReport> ways() const = 0;
  /// How fast the robot may be now.
  [[nodiscard]] virtual record::SpeedLimit speed_limit() const = 0;
  /// Signatures and settings that did not fit or could not be parsed, an implausible pitch, and each suspicion of the
  /// robot's own about its camera. One sentence each.
  [[nodiscard]] virtual const std::vector<std::string>& complaints() const = 0;
};

/// `log` hears every byte of the log that this run writes, but for frames and odometry where they are not wanted:
/// `inputs`. nullptr for an unknown profile name.
std::unique_ptr<Runner> make_runner(std::string_view profile, std::function<void(std::string_view)> log,
                                    bool inputs = true);

/// The names that make_runner knows, as an error message lists them.
inline constexpr std::string_view kProfileNames = "micro, small, full";

}  // namespace fencepost::host
