// The alert in force as a frame of a CAN bus. Its layout for other programs: host/share/can/fencepost_alert.dbc.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hal/base/result.hpp"
#include "hal/bus/can_bus.hpp"
#include "host/live/alert_now.hpp"

namespace fencepost::host {

/// `INTERFACE[:ID]`, the id in hexadecimal as candump writes it: three digits, or eight for 29 bits.
struct CanAlertSpec {
  std::string interface;
  std::uint32_t id = 0x120;
  bool extended = false;
};
/// errors: a sentence that says what is wrong and what is allowed
base::Result<CanAlertSpec, std::string> parse_can_alert(std::string_view text);

/// The eight bytes; numbers of two bytes are little-endian.
///   0: level (bits 0 to 2), may move (3), camera (4 to 6).
///   1: odometry (0 to 2), speed limit (3 to 7), in 0.05 m/s rounded down, 31 not known.
///   2, 3: distance, mm, 0xFFFF not known. 4, 5: bearing, mrad, signed, 0x8000 not known.
///   6: time to contact, 0.1 s, 255 not closing. 7: counter.
/// What a field cannot hold is the nearest that it can. Sensors: 0 absent, 1 silent, 2 unready, 3 empty, 4 ok.
bus::CanFrame alert_frame(const CanAlertSpec& spec, const AlertNow& alert, std::uint8_t counter);

/// Where the frames go.
class FrameSink {
 public:
  virtual ~FrameSink() = default;
  virtual bool send(const bus::CanFrame& frame) = 0;
  virtual void tend(base::Time now) = 0;
  /// Why nothing is taken; empty when all is well.
  [[nodiscard]] virtual std::string problem() const = 0;
};

/// errors: DeviceFailure, where it does not `wait`
std::unique_ptr<FrameSink> open_frame_sink(const CanAlertSpec& spec, bool wait);

/// A frame at each change of level, sensors, permission or object, and at least every 100 ms.
class CanAlert final : public AlertOutput {
 public:
  CanAlert(CanAlertSpec spec, std::unique_ptr<FrameSink> sink) : spec_(std::move(spec)), sink_(std::move(sink)) {}

  void show(const AlertNow& alert, base::Time now) override;
  /// A last frame: blind, and not to move.
  void end(base::Time now) override;
  std::vector<std::string> messages() override;

 private:
  /// Fields that a receiver acts upon at once: a change is sent without delay.
  struct Key {
    record::AlertLevel level = record::AlertLevel::kBlind;
    sensor::LinkState camera = sensor::LinkState::kAbsent;
    sensor::LinkState odometry = sensor::LinkState::kAbsent;
    bool may_move = false;
    std::uint32_t object = 0;
    friend bool operator==(const Key&, const Key&) = default;
  };
  static Key key_of(const AlertNow& alert);
  bool send(const AlertNow& alert, base::Time now);

  CanAlertSpec spec_;
  std::unique_ptr<FrameSink> sink_;
  std::uint8_t counter_ = 0;
  std::optional<Key> sent_;
  base::Time sent_at_;
  std::string said_;
  std::vector<std::string> messages_;
};

}  // namespace fencepost::host
