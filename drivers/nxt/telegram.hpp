// Direct commands of the NXT and their replies, without the link's framing. Source: NXT Bluetooth developer kit,
// appendix 2, direct commands.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "hal/base/fixed.hpp"

namespace fencepost::nxt {

inline constexpr std::size_t kLongestTelegram = 64;
using Telegram = base::FixedVector<std::uint8_t, kLongestTelegram>;

enum class Opcode : std::uint8_t {
  kSetInputMode = 0x05,
  kGetOutputState = 0x06,
  kGetBattery = 0x0B,
  kKeepAlive = 0x0D,
  kSensorStatus = 0x0E,  ///< LSGETSTATUS
  kSensorWrite = 0x0F,   ///< LSWRITE
  kSensorRead = 0x10,    ///< LSREAD
  kGetVersion = 0x88,    ///< the one system command here
};

/// Third byte of a reply.
namespace status {
inline constexpr std::uint8_t kOk = 0x00;
inline constexpr std::uint8_t kPending = 0x20;
inline constexpr std::uint8_t kOutOfRange = 0xC0;
inline constexpr std::uint8_t kBusError = 0xDD;
inline constexpr std::uint8_t kNotConfigured = 0xE0;
}  // namespace status

/// Sensor ports 0 to 3, motor ports 0 to 2 (A to C).
Telegram get_output_state(std::uint8_t port);
/// A powered I2C port: type LOWSPEED_9V, raw.
Telegram set_i2c_port(std::uint8_t port);
Telegram get_battery();
Telegram keep_alive();
Telegram get_version();
Telegram sensor_status(std::uint8_t port);
Telegram sensor_read(std::uint8_t port);

/// Data of one I2C transaction: the address in its 8-bit write form, then what is written; both ways at most 16.
inline constexpr std::size_t kMaxSensorBytes = 16;
/// `address` 7 bits, `out` at most 15 bytes, `expected` at most 16.
Telegram sensor_write(std::uint8_t port, std::uint8_t address, std::span<const std::uint8_t> out, std::size_t expected);

/// Borrowed from its telegram.
struct Reply {
  Opcode opcode = Opcode::kKeepAlive;
  std::uint8_t status = status::kOk;
  std::span<const std::uint8_t> data;  ///< behind the status
};

/// errors: empty unless it is a reply of a known command; one with status 0 has exactly that command's length
std::optional<Reply> reply_in(std::span<const std::uint8_t> telegram);

/// Whether `reply` can be the answer to `request`: the opcode, and where the reply tells it, the port.
bool answers(const Reply& reply, const Telegram& request);

struct Version {
  std::uint8_t protocol_major = 0;
  std::uint8_t protocol_minor = 0;
  std::uint8_t firmware_major = 0;
  std::uint8_t firmware_minor = 0;
  friend constexpr bool operator==(const Version&, const Version&) = default;
};

/// Of a reply with status 0 and the opcode that the name says; anything else is a bug and traps.
Version version_of(const Reply& reply);
std::uint16_t battery_millivolts_of(const Reply& reply);
std::uint8_t ready_bytes_of(const Reply& reply);  ///< LSGETSTATUS
/// LSREAD: as many bytes as the brick says that it read, at most sixteen.
std::span<const std::uint8_t> sensor_bytes_of(const Reply& reply);
/// GETOUTPUTSTATE: degrees since the motor was last reset, forward positive. Command 0A does not clear it.
std::int32_t tacho_of(const Reply& reply);

}  // namespace fencepost::nxt
