// A model of a device at the far end of a cable, stepped by time.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hal/base/units.hpp"
#include "hal/sensor/blob_frame.hpp"
#include "hal/sensor/odometry.hpp"
#include "host/emulate/models/bytes.hpp"
#include "host/emulate/models/not_emulated.hpp"

namespace fencepost::emulate {

/// Mean colour of a signature's things, where it is known.
using Colours = std::function<std::optional<sensor::Rgb>(std::uint8_t)>;

/// How far the robot has come since time began.
struct Travel {
  double distance = 0;   ///< m, along its path, backwards negative
  double heading = 0;    ///< rad, continuous, from zero
  double speed = 0;      ///< m/s now
  double turn_rate = 0;  ///< rad/s now

  /// Way of the rim of a wheel, m.
  [[nodiscard]] double left(double track) const { return distance - heading * track / 2; }
  [[nodiscard]] double right(double track) const { return distance + heading * track / 2; }
};

/// All returned bytes are what the device sends at `now`; the line delays and damages them.
class DeviceModel {
 public:
  virtual ~DeviceModel() = default;

  /// Switched on, or off and on.
  virtual Bytes power_up(base::Time now) = 0;
  /// A byte from the host.
  virtual Bytes take(std::uint8_t byte, base::Time now) = 0;
  /// An image was taken; its boxes are in the device's own pixels.
  virtual Bytes see(const sensor::BlobFrame& /*frame*/, base::Time /*now*/) { return {}; }
  /// The robot's pose at a sample of the feed.
  virtual Bytes pose(const sensor::OdometrySample& /*sample*/, base::Time /*now*/) { return {}; }
  /// Where the wheels are now; called before every other call.
  virtual void roll(const Travel& /*travel*/) {}

  /// When the device next sends something by its own clock; `step` is called then.
  [[nodiscard]] virtual std::optional<base::Time> next() const { return std::nullopt; }
  virtual Bytes step(base::Time /*now*/) { return {}; }

  /// The host has requested the device's data: blocks, packets, counts.
  [[nodiscard]] virtual bool in_use() const { return used_; }
  /// It sends unasked, so being connected is being in use.
  [[nodiscard]] virtual bool talks_unasked() const { return false; }
  /// Baud rate that the host has set; 0: as it was.
  [[nodiscard]] virtual std::uint32_t baud() const { return 0; }
  /// Commands of the host that this model does not know or only acknowledges, by their names.
  [[nodiscard]] virtual std::vector<std::string> not_emulated() const { return not_emulated_.names(); }

 protected:
  bool used_ = false;
  NotEmulated not_emulated_;
};

}  // namespace fencepost::emulate
