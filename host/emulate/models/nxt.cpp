#include "host/emulate/models/nxt.hpp"

#include <algorithm>
#include <cstdio>
#include <string_view>

namespace fencepost::emulate {
namespace {

using Bytes = std::vector<std::uint8_t>;

// Silence that drops a truncated telegram. Assumed: Bluetooth repeats damaged data, so no document says how a brick
// reacts.
constexpr base::Duration kQuiet = base::milliseconds(100);

constexpr std::uint8_t kPending = 0x20;  // status bytes of replies
constexpr std::uint8_t kOutOfRange = 0xC0;
constexpr std::uint8_t kUnknown = 0xBE;
constexpr std::uint8_t kInsane = 0xBF;
constexpr std::uint8_t kBusError = 0xDD;
constexpr std::uint8_t kNotConfigured = 0xE0;

void put32(Bytes& bytes, std::int32_t value) {
  for (unsigned shift = 0; shift < 32; shift += 8) {
    bytes.push_back(static_cast<std::uint8_t>(static_cast<std::uint32_t>(value) >> shift & 0xFFU));
  }
}

// Name, Bluetooth address, signal, free flash.
Bytes device_info() {
  Bytes reply = {0x02, 0x9B, 0};
  for (const char c : std::string_view("NXT\0\0\0\0\0\0\0\0\0\0\0\0", 15))
    reply.push_back(static_cast<std::uint8_t>(c));
  for (const int byte : {0x00, 0x16, 0x53, 0x00, 0x00, 0x01, 0x00}) reply.push_back(static_cast<std::uint8_t>(byte));
  put32(reply, 0);
  put32(reply, 65'536);
  return reply;
}

}  // namespace

void NxtBrick::restart(base::Time now) {
  power_on_ = last_command_ = now;
  zeros_ = block_zeros_ = rotation_zeros_ = motors_;
  framed_.clear();
  for (Port& port : ports_) port = Port{port.device, false, 0, {}, {}};
}

bool NxtBrick::on(base::Time now) const {
  return now - power_on_ >= kBoot && now - std::max(last_command_, power_on_ + kBoot) <= sleep_time_;
}

std::optional<Bytes> NxtBrick::telegram(const Bytes& command, base::Time now) {
  if (!on(now)) return std::nullopt;
  if (command.size() < 2) return std::nullopt;
  const bool direct_command = (command[0] & 0x7FU) == 0x00;
  const bool system_command = (command[0] & 0x7FU) == 0x01;
  if (!direct_command && !system_command) return std::nullopt;
  Bytes reply;
  if (direct_command) {
    reply = direct(command, now);
  } else if (command[1] == 0x88) {
    reply = {0x02, 0x88, 0, 0x7C, 1, 0x1D, 1};
  } else if (command[1] == 0x9B) {
    reply = device_info();
  } else {
    reply = unknown(command);
  }
  // Direct commands without a reply, and with it, both have been carried out.
  if ((command[0] & 0x80U) != 0) return std::nullopt;
  return reply;
}

Bytes NxtBrick::direct(const Bytes& command, base::Time now) {
  const std::uint8_t port = command.size() > 2 ? command[2] : 0xFF;
  switch (command[1]) {
    case 0x05:
      if (command.size() != 5) return {0x02, 0x05, kInsane};
      if (port > 3) return {0x02, 0x05, kOutOfRange};
      ports_[port].low_speed = command[3] == 0x0A || command[3] == 0x0B;
      ports_[port].status = kNotConfigured;
      return {0x02, 0x05, 0};
    case 0x06: motors_read_ = true; return output_state(port);
    case 0x0A: return reset_position(command);
    case 0x0B:
      return {0x02, 0x0B, 0, static_cast<std::uint8_t>(kBattery & 0xFFU), static_cast<std::uint8_t>(kBattery >> 8U)};
    case 0x0D: {
      last_command_ = now;
      Bytes reply = {0x02, 0x0D, 0};
      put32(reply, static_cast<std::int32_t>(sleep_time_.raw / 10));
      return reply;
    }
    case 0x0E:
    case 0x0F:
    case 0x10: return sensor(command, now);
    default: return unknown(command);
  }
}

Bytes NxtBrick::unknown(const Bytes& command) {
  char name[16] = {};
  (void)std::snprintf(name, sizeof name, "0x%02X 0x%02X", command[0] & 0x7FU, command[1]);
  not_emulated_.note(name);
  return {0x02, command[1], kUnknown};
}

Bytes NxtBrick::reset_position(const Bytes& command) {
  if (command.size() != 4) return {0x02, 0x0A, kInsane};
  const std::uint8_t port = command[2];
  if (port > 2) return {0x02, 0x0A, kOutOfRange};
  (command[3] != 0 ? block_zeros_ : rotation_zeros_)[port] = motors_[port];
  return {0x02, 0x0A, 0};
}

Bytes NxtBrick::output_state(std::uint8_t port) const {
  Bytes reply = {0x02, 0x06};
  if (port > 2) {
    reply.push_back(kOutOfRange);
    reply.resize(25, 0);
    return reply;
  }
  for (const int byte : {0, static_cast<int>(port), 75, 0x07, 0x01, 0x00, 0x20}) {
    reply.push_back(static_cast<std::uint8_t>(byte));
  }
  put32(reply, 0);
  put32(reply, motors_[port] - zeros_[port]);
  put32(reply, motors_[port] - block_zeros_[port]);
  put32(reply, motors_[port] - rotation_zeros_[port]);
  return reply;
}

Bytes NxtBrick::sensor(const Bytes& command, base::Time now) {
  const std::uint8_t opcode = command[1];
  if (command.size() < 3 || command[2] > 3) return {0x02, opcode, kOutOfRange};
  Port& port = ports_[command[2]];
  if (opcode == 0x0F) return {0x02, opcode, write(port, command, now)};
  return opcode == 0x0E ? status(port, now) : read(port, now);
}

std::uint8_t NxtBrick::write(Port& port, const Bytes& command, base::Time now) {
  if (!port.low_speed) return kNotConfigured;
  if (command.size() < 6 || command[3] < 1 || command[3] > 16 || command[4] > 16 || command.size() != 5U + command[3]) {
    return kInsane;
  }
  if (now < port.done) return kPending;
  port.done = now + kSensorTime;
  std::optional<Bytes> answer;
  if (port.device != nullptr) {
    answer = port.device->transfer(static_cast<std::uint8_t>(command[5] >> 1U),
                                   Bytes(command.begin() + 6, command.end()), command[4], now);
  }
  port.status = answer ? 0 : kBusError;
  port.received = answer.value_or(Bytes{});
  return 0;
}

Bytes NxtBrick::status(Port& port, base::Time now) {
  if (!port.low_speed) return {0x02, 0x0E, kNotConfigured, 0};
  if (now < port.done) return {0x02, 0x0E, kPending, 0};
  const auto ready = static_cast<std::uint8_t>(port.status == 0 ? port.received.size() : 0);
  return {0x02, 0x0E, port.status, ready};
}

Bytes NxtBrick::read(Port& port, base::Time now) {
  Bytes reply = {0x02, 0x10};
  const bool pending = now < port.done;
  reply.push_back(!port.low_speed ? kNotConfigured : pending ? kPending : port.status);
  const bool good = reply[2] == 0;
  reply.push_back(static_cast<std::uint8_t>(good ? port.received.size() : 0));
  if (good) {
    for (const std::uint8_t byte : port.received) reply.push_back(byte);
  }
  reply.resize(20, 0);
  if (!pending) port.received.clear();
  return reply;
}

std::vector<std::uint8_t> NxtBrick::take(std::uint8_t byte, base::Time now) {
  if (now - last_byte_ > kQuiet) framed_.clear();
  last_byte_ = now;
  framed_.push_back(byte);
  if (framed_.size() < 2) return {};
  const std::size_t length = framed_[0] + 256U * framed_[1];
  if (length < 2 || length > 64) {
    framed_.clear();
    return {};
  }
  if (framed_.size() < 2 + length) return {};
  const auto reply = telegram(Bytes(framed_.begin() + 2, framed_.end()), now);
  framed_.clear();
  if (!reply) return {};
  Bytes out = {static_cast<std::uint8_t>(reply->size()), 0};
  out.insert(out.end(), reply->begin(), reply->end());
  return out;
}

}  // namespace fencepost::emulate
