// A log that is read once, packed as far as there is room, and then replayed from its beginning all the same.
#pragma once

#include <string>
#include <string_view>

#include "host/replay/replay.hpp"
#include "host/text/gunzip.hpp"
#include "host/text/gzip.hpp"

namespace fencepost::host::cli {

class PackedLog {
 public:
  struct Room {
    std::size_t packed;
    std::size_t unpacked;  ///< in the memory of who unpacks it
  };

  /// Reads `source` to its end, or until there is no room for more.
  PackedLog(LogSource source, const Room& room);
  PackedLog(const PackedLog&) = delete;
  PackedLog& operator=(const PackedLog&) = delete;
  ~PackedLog() = default;

  /// All of it is packed, within the room.
  [[nodiscard]] bool whole() const { return whole_; }
  /// As gzip packs it.
  [[nodiscard]] std::string take_packed() { return std::move(packed_); }
  /// All of the log from its beginning, once; the bytes hold until the next call, none at its end.
  std::string_view next();

 private:
  LogSource source_;
  std::string packed_;
  bool whole_ = false;
  Gunzip gunzip_;
  bool from_packed_ = true;
};

}  // namespace fencepost::host::cli
