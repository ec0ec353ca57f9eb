// An NXT brick as its cable sees it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "host/emulate/models/i2c_device.hpp"
#include "host/emulate/models/not_emulated.hpp"

namespace fencepost::emulate {

/// Firmware 1.29. Off for some seconds after power-on, and off for good once it was left alone for longer than its
/// sleep time.
class NxtBrick {
 public:
  static constexpr base::Duration kBoot = base::milliseconds(3'000);
  /// A transfer of some bytes at 9600 bit/s.
  static constexpr base::Duration kSensorTime = base::milliseconds(25);

  explicit NxtBrick(base::Time power_on) : power_on_(power_on), last_command_(power_on) {}

  /// One telegram, as USB carries it; out: the reply, if one is asked for and the brick is on.
  std::optional<std::vector<std::uint8_t>> telegram(const std::vector<std::uint8_t>& command, base::Time now);
  /// The same as bytes behind their lengths, as Bluetooth carries them.
  std::vector<std::uint8_t> take(std::uint8_t byte, base::Time now);

  /// Borrowed.
  void attach(std::size_t port, I2cDevice* device) { ports_.at(port).device = device; }
  /// Degrees, as the motor turned since power-on.
  void turn(std::size_t motor, std::int32_t degrees) { motors_.at(motor) = degrees; }
  void set_sleep_time(base::Duration time) { sleep_time_ = time; }
  void restart(base::Time now);
  [[nodiscard]] bool on(base::Time now) const;
  /// Whether a motor was ever read.
  [[nodiscard]] bool motors_read() const { return motors_read_; }
  /// Commands that it does not know.
  [[nodiscard]] const std::vector<std::string>& not_emulated() const { return not_emulated_.names(); }

 private:
  using Bytes = std::vector<std::uint8_t>;
  struct Port {
    I2cDevice* device = nullptr;
    bool low_speed = false;
    std::uint8_t status = 0;
    base::Time done;
    Bytes received;
  };

  Bytes direct(const Bytes& command, base::Time now);
  Bytes sensor(const Bytes& command, base::Time now);
  static std::uint8_t write(Port& port, const Bytes& command, base::Time now);
  static Bytes status(Port& port, base::Time now);
  static Bytes read(Port& port, base::Time now);
  [[nodiscard]] Bytes output_state(std::uint8_t port) const;
  Bytes unknown(const Bytes& command);
  Bytes reset_position(const Bytes& command);

  base::Time power_on_;
  base::Time last_command_;
  base::Duration sleep_time_ = base::milliseconds(600'000);
  static constexpr std::uint16_t kBattery = 7'800;  ///< mV
  std::array<Port, 4> ports_;
  std::array<std::int32_t, 3> motors_{};
  std::array<std::int32_t, 3> zeros_{};           ///< motor angles at the last power-on
  std::array<std::int32_t, 3> block_zeros_{};     ///< at the last reset of their relative position
  std::array<std::int32_t, 3> rotation_zeros_{};  ///< at the last reset of their absolute position
  bool motors_read_ = false;
  NotEmulated not_emulated_;
  Bytes framed_;
  base::Time last_byte_;
};

}  // namespace fencepost::emulate
