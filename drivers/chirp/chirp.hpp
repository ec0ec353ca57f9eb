// Chirp, the remote calls of Pixy's USB pipe, as far as the packets of protocol.hpp travel inside them. No checksum:
// USB has its own. Source: the vendor's chirp library, as described for the first Pixy.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "drivers/wire/scanner.hpp"
#include "hal/base/fixed.hpp"

namespace fencepost::chirp {

/// A message begins with `55 55 AA AA`, type, pad, procedure (i16) and payload length (u32); the payload follows.
inline constexpr std::size_t kHeader = 12;
/// The first transfer of a message has always this size, filled with anything; all of ours fit into it.
inline constexpr std::size_t kTransfer = 64;
/// Longest message of the camera that is read; longer ones (pictures) are passed over.
inline constexpr std::size_t kLongest = 320;

enum class Type : std::uint8_t { kResponse = 0x40, kEnumerated = 0x60, kInitialised = 0x61 };

using Transfer = base::FixedVector<std::uint8_t, kTransfer>;

/// Block size 64, hints on: first of all.
Transfer initialise();
/// Asks for the number of a procedure; the name has at most 40 characters.
Transfer enumerate(std::string_view procedure);
/// Calls `ser_packet(type, data)`; at most 44 bytes of data.
Transfer call(std::uint16_t procedure, std::uint8_t type, std::span<const std::uint8_t> data);

/// Calls a procedure without arguments.
Transfer call(std::uint16_t procedure);

/// For wire::Scanner. A message ends with its payload: the filler behind it is noise.
wire::Verdict examine(std::span<const std::uint8_t> bytes);

struct Message {
  Type type = Type::kResponse;
  std::int32_t result = 0;             ///< first of the payload; the procedure's number of an enumeration
  std::span<const std::uint8_t> rest;  ///< of the payload, borrowed
};
/// errors: empty for other types, pushed data among them, and without a result
std::optional<Message> message_in(std::span<const std::uint8_t> message);

/// A packet of protocol.hpp without header, which `ser_packet` returns beside its result.
struct Packet {
  std::uint8_t type = 0;
  std::span<const std::uint8_t> data;
};
/// errors: empty if the arguments are of other types or lengths
std::optional<Packet> packet_in(const Message& message);

}  // namespace fencepost::chirp
