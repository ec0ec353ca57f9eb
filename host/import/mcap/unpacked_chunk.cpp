#include "host/import/mcap/unpacked_chunk.hpp"

#include <lz4frame.h>
#include <zstd.h>

#include <memory>

namespace fencepost::host {
namespace {

std::string unpack_lz4(std::string_view packed, std::size_t size) {
  LZ4F_dctx* made = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&made, LZ4F_VERSION)) != 0) return {};
  const std::unique_ptr<LZ4F_dctx, void (*)(LZ4F_dctx*)> context(
      made, [](LZ4F_dctx* c) { LZ4F_freeDecompressionContext(c); });
  std::string bytes(size, '\0');
  std::size_t filled = 0;
  while (filled < size && !packed.empty()) {
    std::size_t room = size - filled;
    std::size_t used = packed.size();
    const std::size_t hint =
        LZ4F_decompress(context.get(), bytes.data() + filled, &room, packed.data(), &used, nullptr);
    if (LZ4F_isError(hint) != 0 || (room == 0 && used == 0)) break;
    filled += room;
    packed.remove_prefix(used);
  }
  bytes.resize(filled);
  return bytes;
}

std::string unpack_zstd(std::string_view packed, std::size_t size) {
  std::string bytes(size, '\0');
  const std::size_t filled = ZSTD_decompress(bytes.data(), bytes.size(), packed.data(), packed.size());
  bytes.resize(ZSTD_isError(filled) != 0 ? 0 : filled);
  return bytes;
}

}  // namespace

const std::string_view kReadCompression = "zstd";

std::optional<std::string> unpacked_chunk(std::string_view compression, std::string_view packed, std::size_t size) {
  if (compression == "lz4") return unpack_lz4(packed, size);
  if (compression == "zstd") return unpack_zstd(packed, size);
  return std::nullopt;
}

}  // namespace fencepost::host
