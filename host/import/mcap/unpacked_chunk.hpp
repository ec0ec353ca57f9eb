// Chunks of an MCAP file that are packed. A build without lz4 and zstd unpacks none.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace fencepost::host {

/// One that is unpacked, by the name that the mcap tool has for it.
extern const std::string_view kReadCompression;

/// `size`: unpacked; a damaged chunk gives less. Nothing: `compression` is unknown.
std::optional<std::string> unpacked_chunk(std::string_view compression, std::string_view packed, std::size_t size);

}  // namespace fencepost::host
