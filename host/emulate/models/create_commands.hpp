// The Open Interface of a Create 1 and of a Create 2: opcodes with their arguments, packets with their sizes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace fencepost::emulate {

enum class CreateModel : std::uint8_t { kOne, kTwo };

/// Bytes behind the opcode that `command` begins with, as far as it has come: where they hold a count, that many more.
/// nullopt: the model's manual has no such opcode.
std::optional<std::size_t> create_arguments(CreateModel model, std::string_view command);

/// Size of the packet, 1 or 2 bytes; 0: the model has none of this number.
std::size_t create_packet_size(CreateModel model, int id);

/// Packets of a group such as 0, 6 or 100, in their order; empty: it is no group of the model.
std::vector<int> create_group(CreateModel model, int id);

}  // namespace fencepost::emulate
