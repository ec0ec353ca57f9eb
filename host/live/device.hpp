// One interface for all cameras and one for all odometries, so that one loop serves them.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "hal/linux/wait.hpp"
#include "hal/sensor/camera.hpp"
#include "hal/sensor/sources.hpp"
#include "host/live/link_wording.hpp"
#include "host/live/port.hpp"

namespace fencepost::host {

class Device {
 public:
  virtual ~Device() = default;
  [[nodiscard]] virtual sensor::LinkState link() const = 0;
  /// Once per loop iteration, before it is polled.
  virtual void tend(base::Time /*now*/) {}
  /// Adds what wakes the loop when something arrives.
  virtual void watch(linux::WaitSet& /*set*/) const {}
  /// Why it is absent, a sentence without full stop; empty where that is not known.
  [[nodiscard]] virtual std::string problem() const { return {}; }
  /// How long the loop may sleep if nothing arrives: drivers poll their devices and detect time-outs.
  [[nodiscard]] virtual base::Duration patience() const { return base::milliseconds(100); }
  /// How many inputs for it the console gave so far.
  virtual void console_gave(std::uint64_t /*inputs*/) {}
  /// It has a cable of its own, whose state is reported; the console's inputs have none.
  [[nodiscard]] virtual bool cabled() const { return true; }

  /// Its name, for the messages below; before that nothing is reported of it.
  void introduce(DeviceLabel label) { label_ = std::move(label); }
  /// People read standard error beside the console: the loop then writes the records only.
  void leave_sentences_to_others() { sentences_ = false; }
  [[nodiscard]] LinkWording wording(sensor::LinkState state) const {
    return label_ && cabled() ? word_link(*label_, state, problem()) : LinkWording{};
  }
  /// Asked by the loop when it has to say how the link is (firmware/console/link_words.hpp).
  [[nodiscard]] LinkWording link_words(sensor::LinkState state) const {
    LinkWording words = wording(state);
    if (!sentences_) words.name.clear();
    return words;
  }

 private:
  std::optional<DeviceLabel> label_;
  bool sentences_ = true;
};

class CameraDevice : public Device {
 public:
  virtual base::Result<sensor::BlobFrame> poll(base::Time now) = 0;
  [[nodiscard]] virtual std::uint32_t dropped() const = 0;
};
static_assert(sensor::BlobCamera<CameraDevice>);

class OdometryDevice : public Device {
 public:
  virtual base::Result<sensor::OdometrySample> poll(base::Time now) = 0;
  /// Allows a base that drives by itself a speed, mm/s, once a turn of the loop; it obeys at once.
  virtual void allow_motion(std::int16_t /*most*/, base::Time /*now*/) {}
  /// The run is over: a base that drives stops.
  virtual void stand(base::Time /*now*/) {}
};
static_assert(sensor::OdometrySource<OdometryDevice>);

inline sensor::LinkState console_link(std::uint64_t inputs) {
  return inputs > 0 ? sensor::LinkState::kOk : sensor::LinkState::kSilent;
}

/// Frames come as $FPFRM lines on the console: nothing to poll.
class ConsoleCamera final : public CameraDevice {
 public:
  base::Result<sensor::BlobFrame> poll(base::Time /*now*/) override { return base::Error::kNotReady; }
  [[nodiscard]] sensor::LinkState link() const override { return link_; }
  void console_gave(std::uint64_t inputs) override { link_ = console_link(inputs); }
  [[nodiscard]] std::uint32_t dropped() const override { return 0; }
  [[nodiscard]] bool cabled() const override { return false; }

 private:
  sensor::LinkState link_ = sensor::LinkState::kSilent;
};

/// The same for $FPODO.
class ConsoleOdometry final : public OdometryDevice {
 public:
  base::Result<sensor::OdometrySample> poll(base::Time /*now*/) override { return base::Error::kNotReady; }
  [[nodiscard]] sensor::LinkState link() const override { return link_; }
  void console_gave(std::uint64_t inputs) override { link_ = console_link(inputs); }
  [[nodiscard]] bool cabled() const override { return false; }

 private:
  sensor::LinkState link_ = sensor::LinkState::kSilent;
};

/// A missing device is not polled.
inline base::Duration patience_with(const Port& port, base::Duration patience) {
  return port.connected() ? patience : linux::kRetryInterval;
}

/// A driver on its port. `Stack` owns both, in the order in which they need each other: `port()` and `driver`.
template <class Base, class Stack>
class PortedDevice : public Base {
 public:
  template <class... Arguments>
  explicit PortedDevice(base::Duration patience, Arguments&&... arguments)
      : stack_(std::forward<Arguments>(arguments)...), patience_(patience) {}

  [[nodiscard]] sensor::LinkState link() const override {
    return stack_.port().connected() ? stack_.driver.link() : sensor::LinkState::kAbsent;
  }
  void tend(base::Time now) override { stack_.port().tend(now); }
  void watch(linux::WaitSet& set) const override { set.add_readable(stack_.port().descriptor()); }
  [[nodiscard]] std::string problem() const override { return stack_.port().problem(); }
  [[nodiscard]] base::Duration patience() const override { return patience_with(stack_.port(), patience_); }

 protected:
  Stack stack_;

 private:
  base::Duration patience_;
};

template <class Stack>
class PortedCamera final : public PortedDevice<CameraDevice, Stack> {
 public:
  using PortedDevice<CameraDevice, Stack>::PortedDevice;
  base::Result<sensor::BlobFrame> poll(base::Time now) override { return this->stack_.driver.poll(now); }
  [[nodiscard]] std::uint32_t dropped() const override { return this->stack_.driver.dropped(); }
};

template <class Stack>
class PortedOdometry final : public PortedDevice<OdometryDevice, Stack> {
 public:
  using PortedDevice<OdometryDevice, Stack>::PortedDevice;
  base::Result<sensor::OdometrySample> poll(base::Time now) override { return this->stack_.driver.poll(now); }
};

/// The devices that a run polls.
struct Devices {
  std::unique_ptr<OdometryDevice> odometry;
  std::unique_ptr<CameraDevice> camera;
  /// The camera's own profile with the robot's numbers over it; empty where the calibration comes over the console.
  std::optional<sensor::CameraIntrinsics> intrinsics;
};

}  // namespace fencepost::host
