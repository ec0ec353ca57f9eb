#include "host/import/mcap/mcap_file.hpp"

#include <map>
#include <optional>

#include "host/import/fields.hpp"
#include "host/import/mcap/unpacked_chunk.hpp"
#include "host/import/table.hpp"

namespace fencepost::host {
namespace {

constexpr std::string_view kMagic("\x89MCAP0\r\n", 8);
/// Bytes, unpacked: recorders write chunks of 1 to 4 MB. Beyond, a damaged length.
constexpr std::uint64_t kMaxChunk = 1ULL << 26U;

enum Opcode : std::uint8_t { kSchema = 0x03, kChannel = 0x04, kMessage = 0x05, kChunk = 0x06, kDataEnd = 0x0F };

class McapReader {
 public:
  McapReader(const std::string& file, const std::function<void(const McapMessage&)>& take) : file_(file), take_(take) {}

  void read(std::string_view bytes) {
    Fields fields(bytes);
    while (!fields.rest().empty() && !ended_) {
      const auto opcode = fields.integer<std::uint8_t>();
      const std::string_view content = fields.take(fields.integer<std::uint64_t>());
      if (fields.ended_early()) {
        end_.truncated = true;
        return;
      }
      take_record(opcode, content);
    }
  }
  [[nodiscard]] McapEnd end() const {
    McapEnd end = end_;
    end.truncated = end.truncated || !ended_;
    return end;
  }

 private:
  struct Channel {
    std::string topic;
    std::string encoding;
    std::uint16_t schema = 0;
  };

  void take_record(std::uint8_t opcode, std::string_view content) {
    Fields fields(content);
    switch (opcode) {
      case kSchema: {
        const auto id = fields.integer<std::uint16_t>();
        schemas_[id] = fields.string();
        break;
      }
      case kChannel: {
        const auto id = fields.integer<std::uint16_t>();
        Channel& channel = channels_[id];
        channel.schema = fields.integer<std::uint16_t>();
        channel.topic = fields.string();
        channel.encoding = fields.string();
        break;
      }
      case kMessage: take_message(fields); break;
      case kChunk: take_chunk(fields); break;
      case kDataEnd: ended_ = true; break;
      default: break;  // the specification asks readers to pass over what they do not know
    }
  }
  void take_message(Fields& fields) {
    const auto channel = channels_.find(fields.integer<std::uint16_t>());
    static_cast<void>(fields.integer<std::uint32_t>());  // sequence
    const auto log_time = fields.integer<std::uint64_t>();
    static_cast<void>(fields.integer<std::uint64_t>());  // publish_time
    if (channel == channels_.end() || fields.ended_early()) return;
    take_({channel->second.topic, schemas_[channel->second.schema], channel->second.encoding,
           static_cast<double>(log_time) * 1e-9, fields.rest()});
  }
  void take_chunk(Fields& fields) {
    static_cast<void>(fields.take(16));  // times of its messages
    const auto size = fields.integer<std::uint64_t>();
    static_cast<void>(fields.integer<std::uint32_t>());  // CRC-32 of the chunk
    const std::string compression(fields.string());
    const std::string_view packed = fields.take(fields.integer<std::uint64_t>());
    // A chunk within a chunk, which the specification does not know, could be within itself.
    if (in_chunk_ || fields.ended_early()) throw damaged();
    in_chunk_ = true;
    read_chunk(compression, packed, size);
    in_chunk_ = false;
  }
  void read_chunk(const std::string& compression, std::string_view packed, std::uint64_t size) {
    if (compression.empty()) return read(packed);
    if (size > kMaxChunk) {
      throw ImportProblem{file_, "has a chunk that becomes more than " + std::to_string(kMaxChunk >> 20U) + " MB",
                          "write it anew: mcap compress --chunk-size 4194304"};
    }
    const std::optional<std::string> bytes = unpacked_chunk(compression, packed, size);
    if (!bytes) {
      throw ImportProblem{file_, "has chunks compressed by \"" + compression + "\"",
                          "write it anew: mcap compress --compression " + std::string(kReadCompression)};
    }
    if (bytes->size() != size) throw damaged();
    read(*bytes);
  }
  [[nodiscard]] ImportProblem damaged() const {
    return {file_, "has a chunk that is damaged", "try 'mcap recover' on it, or copy it again"};
  }

  const std::string& file_;
  const std::function<void(const McapMessage&)>& take_;
  std::map<std::uint16_t, std::string> schemas_;
  std::map<std::uint16_t, Channel> channels_;
  bool in_chunk_ = false;
  bool ended_ = false;
  McapEnd end_;
};

}  // namespace

McapEnd read_mcap(std::string_view bytes, const std::string& file,
                  const std::function<void(const McapMessage&)>& take) {
  if (!bytes.starts_with(kMagic)) {
    throw ImportProblem{file, "is no MCAP file", "a bag of SQLite (.db3) is converted by 'ros2 bag convert'"};
  }
  McapReader reader(file, take);
  reader.read(bytes.substr(kMagic.size()));
  return reader.end();
}

}  // namespace fencepost::host
