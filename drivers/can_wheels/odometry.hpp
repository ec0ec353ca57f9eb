// The pump: wheels on a CAN bus.
#pragma once

#include "drivers/can_wheels/wheels.hpp"
#include "hal/bus/can_bus.hpp"
#include "hal/sensor/sources.hpp"

namespace fencepost::can_wheels {

template <bus::CanBus Bus>
class Odometry {
 public:
  Odometry(Bus& bus, const Mapping& mapping) : bus_(bus), wheels_(mapping) {}

  /// A frame's time is the bus's time stamp if it has one, else `now`.
  base::Result<sensor::OdometrySample> poll(base::Time now) {
    now_ = now;
    for (int i = 0; i < kFrames; ++i) {
      const base::Result<bus::CanFrame> frame = bus_.receive();
      if (!frame) {
        if (frame.error() == base::Error::kBadInput) {
          ++bus_errors_;
          continue;
        }
        absent_ = frame.error() == base::Error::kGone;
        if (absent_) wheels_.forget();
        return base::Error::kNotReady;
      }
      absent_ = false;
      if (const auto sample = wheels_.take(*frame, frame->received.value_or(now))) return in_order(*sample);
    }
    return base::Error::kNotReady;
  }

  [[nodiscard]] sensor::LinkState link() const { return absent_ ? sensor::LinkState::kAbsent : wheels_.link(now_); }
  [[nodiscard]] const Wheels& wheels() const { return wheels_; }
  [[nodiscard]] std::uint32_t bus_errors() const { return bus_errors_; }

 private:
  // A bus of 1 Mbit/s delivers eight a millisecond; the rest waits for the next iteration.
  static constexpr int kFrames = 32;

  // Two samples with equal times, on a bus without time stamps: the next frame repeats the later one.
  base::Result<sensor::OdometrySample> in_order(const sensor::OdometrySample& sample) {
    if (last_ && sample.t <= *last_) return base::Error::kNotReady;
    last_ = sample.t;
    return sample;
  }

  Bus& bus_;
  Wheels wheels_;
  base::Time now_;
  bool absent_ = false;
  std::optional<base::Time> last_;
  std::uint32_t bus_errors_ = 0;
};

}  // namespace fencepost::can_wheels
