#include "host/export/mcap/packed_chunk.hpp"

#include <zstd.h>

#include <stdexcept>

namespace fencepost::host::exports {

const std::string_view kChunkCompression = "zstd";

std::string packed_chunk(std::string_view bytes) {
  std::string room(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size = ZSTD_compress(room.data(), room.size(), bytes.data(), bytes.size(), ZSTD_CLEVEL_DEFAULT);
  if (ZSTD_isError(size) != 0) throw std::runtime_error(std::string("zstd: ") + ZSTD_getErrorName(size));
  room.resize(size);
  return room;
}

}  // namespace fencepost::host::exports
