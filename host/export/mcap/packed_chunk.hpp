// How an MCAP file's chunks are packed: by zstd, or not at all where a build has no such library.
#pragma once

#include <string>
#include <string_view>

namespace fencepost::host::exports {

/// As the specification names it; empty: not packed.
extern const std::string_view kChunkCompression;

std::string packed_chunk(std::string_view bytes);

}  // namespace fencepost::host::exports
