#include "drivers/nxt/telegram.hpp"

#include <algorithm>
#include <initializer_list>

#include "drivers/wire/endian.hpp"

namespace fencepost::nxt {
namespace {

constexpr std::uint8_t kDirect = 0x00;
constexpr std::uint8_t kSystem = 0x01;
constexpr std::uint8_t kReply = 0x02;
constexpr std::size_t kReplyHeader = 3;

Telegram make(std::initializer_list<std::uint8_t> bytes) {
  Telegram telegram;
  for (const std::uint8_t byte : bytes) (void)telegram.push_back(byte);
  return telegram;
}

Telegram direct(Opcode opcode) { return make({kDirect, static_cast<std::uint8_t>(opcode)}); }
Telegram direct(Opcode opcode, std::uint8_t port) { return make({kDirect, static_cast<std::uint8_t>(opcode), port}); }

// Whole reply, header included; 0: no command of ours.
std::size_t reply_length(Opcode opcode) {
  switch (opcode) {
    case Opcode::kSetInputMode:
    case Opcode::kSensorWrite: return kReplyHeader;
    case Opcode::kSensorStatus: return 4;
    case Opcode::kGetBattery: return 5;
    case Opcode::kKeepAlive:
    case Opcode::kGetVersion: return 7;
    case Opcode::kSensorRead: return 20;
    case Opcode::kGetOutputState: return 25;
  }
  return 0;
}

void require(const Reply& reply, Opcode opcode) {
  FENCEPOST_CHECK(reply.opcode == opcode && reply.status == status::kOk);
}

}  // namespace

Telegram get_output_state(std::uint8_t port) { return direct(Opcode::kGetOutputState, port); }
Telegram set_i2c_port(std::uint8_t port) {
  constexpr std::uint8_t kLowSpeed9V = 0x0B;
  return make({kDirect, static_cast<std::uint8_t>(Opcode::kSetInputMode), port, kLowSpeed9V, 0});
}
Telegram get_battery() { return direct(Opcode::kGetBattery); }
Telegram keep_alive() { return direct(Opcode::kKeepAlive); }
Telegram get_version() { return make({kSystem, static_cast<std::uint8_t>(Opcode::kGetVersion)}); }
Telegram sensor_status(std::uint8_t port) { return direct(Opcode::kSensorStatus, port); }
Telegram sensor_read(std::uint8_t port) { return direct(Opcode::kSensorRead, port); }

Telegram sensor_write(std::uint8_t port, std::uint8_t address, std::span<const std::uint8_t> out,
                      std::size_t expected) {
  FENCEPOST_CHECK(out.size() < kMaxSensorBytes && expected <= kMaxSensorBytes && address < 0x80);
  Telegram telegram = direct(Opcode::kSensorWrite, port);
  const auto sent = static_cast<std::uint8_t>(out.size() + 1);
  for (const std::uint8_t byte :
       {sent, static_cast<std::uint8_t>(expected), static_cast<std::uint8_t>(address << 1U)}) {
    (void)telegram.push_back(byte);
  }
  for (const std::uint8_t byte : out) (void)telegram.push_back(byte);
  return telegram;
}

std::optional<Reply> reply_in(std::span<const std::uint8_t> telegram) {
  if (telegram.size() < kReplyHeader || telegram[0] != kReply) return std::nullopt;
  const Reply reply{static_cast<Opcode>(telegram[1]), telegram[2], telegram.subspan(kReplyHeader)};
  const std::size_t length = reply_length(reply.opcode);
  // An error may come with the zeros of the rest, or short.
  const bool fits = reply.status == status::kOk ? telegram.size() == length : telegram.size() <= length;
  if (!fits) return std::nullopt;
  return reply;
}

bool answers(const Reply& reply, const Telegram& request) {
  if (request.size() < 2 || request[1] != static_cast<std::uint8_t>(reply.opcode)) return false;
  const bool tells_port = reply.opcode == Opcode::kGetOutputState && reply.status == status::kOk;
  return !tells_port || reply.data[0] == request[2];
}

Version version_of(const Reply& reply) {
  require(reply, Opcode::kGetVersion);
  return {reply.data[1], reply.data[0], reply.data[3], reply.data[2]};
}

std::uint16_t battery_millivolts_of(const Reply& reply) {
  require(reply, Opcode::kGetBattery);
  return wire::little_u16(reply.data, 0);
}

std::uint8_t ready_bytes_of(const Reply& reply) {
  require(reply, Opcode::kSensorStatus);
  return reply.data[0];
}

std::span<const std::uint8_t> sensor_bytes_of(const Reply& reply) {
  require(reply, Opcode::kSensorRead);
  return reply.data.subspan(1, std::min<std::size_t>(reply.data[0], kMaxSensorBytes));
}

std::int32_t tacho_of(const Reply& reply) {
  require(reply, Opcode::kGetOutputState);
  constexpr std::size_t kTachoAt = 13 - kReplyHeader;
  return wire::little_i32(reply.data, kTachoAt);
}

}  // namespace fencepost::nxt
