#include "drivers/chirp/chirp.hpp"

#include "drivers/wire/endian.hpp"

namespace fencepost::chirp {
namespace {

constexpr std::uint8_t kCall = 0x80;
constexpr std::uint8_t kEnumerate = 0xA0;
constexpr std::uint8_t kInit = 0xA1;
constexpr std::uint8_t kInt8 = 0x01;
constexpr std::uint8_t kInt16 = 0x02;
constexpr std::uint8_t kString = 0xA1;
constexpr std::uint8_t kBytes = 0x81;
constexpr std::uint8_t kStart = 0x55;

// Values are aligned to their size, counted from the header's start; the gap repeats the type.
class Writer {
 public:
  Writer(std::uint8_t type, std::uint16_t procedure) {
    for (const std::uint8_t byte : {kStart, kStart, std::uint8_t{0xAA}, std::uint8_t{0xAA}, type, std::uint8_t{0},
                                    wire::low(procedure), wire::high(procedure)}) {
      put(byte);
    }
    for (int i = 0; i < 4; ++i) put(0);
  }
  void put(std::uint8_t byte) { FENCEPOST_CHECK(transfer_.push_back(byte)); }
  void put_type(std::uint8_t type, std::size_t alignment) {
    do {
      put(type);
    } while (transfer_.size() % alignment != 0);
  }
  Transfer finish() {
    transfer_[kHeader - 4] = static_cast<std::uint8_t>(transfer_.size() - kHeader);
    while (transfer_.push_back(0)) {
    }
    return transfer_;
  }

 private:
  Transfer transfer_;
};

}  // namespace

Transfer initialise() {
  Writer writer(kInit, 0);
  writer.put_type(kInt16, 2);
  writer.put(static_cast<std::uint8_t>(kTransfer));
  writer.put(0);
  writer.put_type(kInt8, 1);
  writer.put(1);
  return writer.finish();
}

Transfer enumerate(std::string_view procedure) {
  Writer writer(kEnumerate, 0);
  writer.put_type(kString, 1);
  for (const char c : procedure) writer.put(static_cast<std::uint8_t>(c));
  writer.put(0);
  writer.put_type(kInt16, 2);
  writer.put(0xFF);
  writer.put(0xFF);
  return writer.finish();
}

Transfer call(std::uint16_t procedure, std::uint8_t type, std::span<const std::uint8_t> data) {
  Writer writer(kCall, procedure);
  writer.put_type(kInt8, 1);
  writer.put(type);
  writer.put_type(kBytes, 4);
  writer.put(static_cast<std::uint8_t>(data.size()));
  for (int i = 0; i < 3; ++i) writer.put(0);
  for (const std::uint8_t byte : data) writer.put(byte);
  return writer.finish();
}

Transfer call(std::uint16_t procedure) { return Writer(kCall, procedure).finish(); }

wire::Verdict examine(std::span<const std::uint8_t> bytes) {
  constexpr std::uint8_t kMark[] = {kStart, kStart, 0xAA, 0xAA};
  for (std::size_t i = 0; i < 4 && i < bytes.size(); ++i) {
    if (bytes[i] != kMark[i]) return {wire::Front::kNoise, wire::skip_to(bytes, kStart)};
  }
  if (bytes.size() < kHeader) return {};
  const std::uint32_t length = wire::little_u32(bytes, kHeader - 4);
  if (length > kLongest - kHeader) return {wire::Front::kNoise, wire::skip_to(bytes, kStart)};
  if (bytes.size() < kHeader + length) return {};
  return {wire::Front::kMessage, kHeader + length};
}

std::optional<Message> message_in(std::span<const std::uint8_t> message) {
  if (message.size() < kHeader + 4) return std::nullopt;
  const auto type = static_cast<Type>(message[4]);
  if (type != Type::kResponse && type != Type::kEnumerated && type != Type::kInitialised) return std::nullopt;
  return Message{type, wire::little_i32(message, kHeader), message.subspan(kHeader + 4)};
}

// Behind the result, at 16: 01 type, 81 81, count at 20.
std::optional<Packet> packet_in(const Message& message) {
  constexpr std::size_t kData = 8;
  const std::span<const std::uint8_t> rest = message.rest;
  if (rest.size() < kData || rest[0] != kInt8 || rest[2] != kBytes) return std::nullopt;
  const std::uint32_t count = wire::little_u32(rest, 4);
  if (count > 0xFF || rest.size() != kData + count) return std::nullopt;
  return Packet{rest[1], rest.subspan(kData)};
}

}  // namespace fencepost::chirp
