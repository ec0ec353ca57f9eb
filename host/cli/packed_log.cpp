#include "host/cli/packed_log.hpp"

#include <utility>

namespace fencepost::host::cli {

PackedLog::PackedLog(LogSource source, const Room& room) : source_(std::move(source)) {
  Gzip gzip;
  std::size_t unpacked = 0;
  bool ended = false;
  while (!ended && gzip.packed().size() <= room.packed && unpacked <= room.unpacked) {
    const std::string_view bytes = source_();
    ended = bytes.empty();
    unpacked += bytes.size();
    gzip.feed(bytes);
  }
  gzip.finish();
  packed_ = gzip.take();
  whole_ = ended && packed_.size() <= room.packed && unpacked <= room.unpacked;
  gunzip_.feed(packed_);
}

std::string_view PackedLog::next() {
  if (from_packed_) {
    const std::string_view bytes = gunzip_.next();
    if (!bytes.empty()) return bytes;
    from_packed_ = false;
    if (!whole_) packed_ = {};
  }
  return whole_ ? std::string_view() : source_();
}

}  // namespace fencepost::host::cli
