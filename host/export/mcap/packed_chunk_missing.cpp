#include "host/export/mcap/packed_chunk.hpp"

namespace fencepost::host::exports {

const std::string_view kChunkCompression = "";

std::string packed_chunk(std::string_view bytes) { return std::string(bytes); }

}  // namespace fencepost::host::exports
