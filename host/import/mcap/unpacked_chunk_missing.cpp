#include "host/import/mcap/unpacked_chunk.hpp"

namespace fencepost::host {

const std::string_view kReadCompression = "none";

std::optional<std::string> unpacked_chunk(std::string_view /*compression*/, std::string_view /*packed*/,
                                          std::size_t /*size*/) {
  return std::nullopt;
}

}  // namespace fencepost::host
