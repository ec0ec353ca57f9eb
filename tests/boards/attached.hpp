// An emulated device at one of a board's serial lines, moved along by the machine's clock.
#pragma once

#include <memory>

#include "hal/base/units.hpp"
#include "host/emulate/models/device_model.hpp"
#include "host/emulate/scene/travel.hpp"
#include "tests/boards/line.hpp"

namespace fencepost::test {

class Attached {
 public:
  /// Switched on at `now`; `line` is borrowed.
  Attached(Line& line, std::unique_ptr<emulate::DeviceModel> model, base::Time now);

  /// Brings the device the board's bytes, and the board the device's answers by the device's clock.
  void pump(base::Time now);
  void see(const sensor::BlobFrame& frame, base::Time now);
  /// Which way its wheels will go; `roll` goes it, in the way's own time.
  void drive(std::span<const sensor::OdometrySample> way) { way_ = emulate::TravelLog(way); }
  void roll(base::Time t) { model_->roll(way_.at(t)); }

  /// The cable is pulled, or back.
  void unplug(bool unplugged) { unplugged_ = unplugged; }
  [[nodiscard]] bool in_use() const { return model_->in_use(); }

 private:
  void say(const emulate::Bytes& bytes);

  Line& line_;
  std::unique_ptr<emulate::DeviceModel> model_;
  emulate::TravelLog way_{{}};
  bool unplugged_ = false;
};

}  // namespace fencepost::test
