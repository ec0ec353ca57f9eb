// Writes MCAP files (mcap.dev, specification 0x0): chunks of zstd with message indexes, a summary, checksums.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace fencepost::host::exports {

struct McapSchema {
  std::string name;
  std::string encoding;  ///< "jsonschema", "ros2msg"
  std::string text;
};

/// Files of one profile ("" or "ros2") whose channels have one message encoding ("json", "cdr").
class McapWriter {
 public:
  McapWriter(std::string_view profile, std::string_view library, std::string message_encoding);

  /// Before the messages. The channel's number.
  std::uint16_t add_channel(const std::string& topic, const McapSchema& schema,
                            const std::map<std::string, std::string>& metadata = {});
  /// `time` in ns; any order, though readers are fastest where it rises.
  void write(std::uint16_t channel, std::uint64_t time, std::string_view data);
  void attach(std::string_view name, std::string_view media_type, std::uint64_t time, std::string_view data);
  void add_metadata(std::string_view name, const std::map<std::string, std::string>& values);
  /// The bytes of the whole file. The last call.
  std::string finish();

  /// Packed on their own, and read whole by viewers.
  static constexpr std::size_t kFullChunk = 1U << 20U;  ///< bytes, before packing

 private:
  struct Entry {
    std::uint64_t time;
    std::uint64_t offset;
  };

  void end_chunk();
  std::string summary(std::uint64_t start);
  std::string statistics() const;

  std::string file_;
  std::string encoding_;
  std::map<std::string, std::uint16_t> schema_ids_;  ///< by name
  std::string schemas_;                              ///< their records
  std::string channels_;
  std::vector<std::uint32_t> sequences_;  ///< messages by channel - 1
  std::string chunk_;
  std::map<std::uint16_t, std::vector<Entry>> chunk_index_;
  std::uint64_t chunk_start_ = 0;
  std::uint64_t chunk_end_ = 0;
  std::string chunk_indexes_;
  std::string attachment_indexes_;
  std::string metadata_indexes_;
  std::uint32_t chunks_ = 0;
  std::uint32_t attachments_ = 0;
  std::uint32_t metadata_ = 0;
  std::uint64_t messages_ = 0;
  std::uint64_t first_time_ = 0;
  std::uint64_t last_time_ = 0;
};

}  // namespace fencepost::host::exports
