#include "host/export/mcap/mcap_writer.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <utility>

#include "host/export/mcap/packed_chunk.hpp"

namespace fencepost::host::exports {
namespace {

constexpr std::string_view kMcapMagic("\x89MCAP0\r\n", 8);

enum Opcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kAttachment = 0x09,
  kAttachmentIndex = 0x0A,
  kStatistics = 0x0B,
  kMetadata = 0x0C,
  kMetadataIndex = 0x0D,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

/// Little-endian fields.
class Fields {
 public:
  template <class Integer>
  Fields& integer(Integer value) {
    for (std::size_t i = 0; i < sizeof(Integer); ++i) {
      bytes_.push_back(static_cast<char>(static_cast<std::uint8_t>(static_cast<std::uint64_t>(value) >> (8 * i))));
    }
    return *this;
  }
  Fields& raw(std::string_view bytes) {
    bytes_ += bytes;
    return *this;
  }
  Fields& string(std::string_view text) { return integer(static_cast<std::uint32_t>(text.size())).raw(text); }
  /// A list with its number of bytes in front.
  Fields& list(const Fields& items) { return string(items.bytes_); }
  Fields& strings(const std::map<std::string, std::string>& values) {
    Fields items;
    for (const auto& [key, value] : values) items.string(key).string(value);
    return list(items);
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

std::string record(Opcode opcode, std::string_view content) {
  return Fields().integer(opcode).integer<std::uint64_t>(content.size()).raw(content).bytes();
}

std::uint32_t crc_of(std::string_view bytes) {
  return static_cast<std::uint32_t>(::crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace

McapWriter::McapWriter(std::string_view profile, std::string_view library, std::string message_encoding)
    : encoding_(std::move(message_encoding)) {
  file_ = std::string(kMcapMagic) + record(kHeader, Fields().string(profile).string(library).bytes());
}

std::uint16_t McapWriter::add_channel(const std::string& topic, const McapSchema& schema,
                                      const std::map<std::string, std::string>& metadata) {
  const auto [known, added] = schema_ids_.try_emplace(schema.name, static_cast<std::uint16_t>(schema_ids_.size() + 1));
  if (added) {
    const std::string made =
        record(kSchema,
               Fields().integer(known->second).string(schema.name).string(schema.encoding).string(schema.text).bytes());
    schemas_ += made;
    chunk_ += made;  // before the messages that need it, for readers that go from the front
  }
  sequences_.push_back(0);
  const auto id = static_cast<std::uint16_t>(sequences_.size());
  const std::string made = record(
      kChannel, Fields().integer(id).integer(known->second).string(topic).string(encoding_).strings(metadata).bytes());
  channels_ += made;
  chunk_ += made;
  return id;
}

void McapWriter::write(std::uint16_t channel, std::uint64_t time, std::string_view data) {
  std::vector<Entry>& index = chunk_index_[channel];
  chunk_start_ = chunk_index_.size() == 1 && index.empty() ? time : std::min(chunk_start_, time);
  chunk_end_ = std::max(chunk_end_, time);
  first_time_ = messages_ == 0 ? time : std::min(first_time_, time);
  last_time_ = std::max(last_time_, time);
  ++messages_;
  index.push_back({time, chunk_.size()});
  Fields head;
  head.integer(channel).integer(sequences_[channel - 1U]++).integer(time).integer(time);
  chunk_ += Fields().integer(kMessage).integer<std::uint64_t>(head.bytes().size() + data.size()).bytes();
  chunk_ += head.bytes();
  chunk_ += data;
  if (chunk_.size() >= kFullChunk) end_chunk();
}

void McapWriter::end_chunk() {
  if (chunk_.empty()) return;
  const std::string bytes = packed_chunk(chunk_);
  const std::uint64_t at = file_.size();
  file_ += record(kChunk, Fields()
                              .integer(chunk_start_)
                              .integer(chunk_end_)
                              .integer<std::uint64_t>(chunk_.size())
                              .integer(crc_of(chunk_))
                              .string(kChunkCompression)
                              .integer<std::uint64_t>(bytes.size())
                              .raw(bytes)
                              .bytes());
  const std::uint64_t end = file_.size();
  Fields offsets;
  for (auto& [channel, entries] : chunk_index_) {
    std::ranges::stable_sort(entries, {}, &Entry::time);
    Fields items;
    for (const Entry& entry : entries) items.integer(entry.time).integer(entry.offset);
    offsets.integer(channel).integer<std::uint64_t>(file_.size());
    file_ += record(kMessageIndex, Fields().integer(channel).list(items).bytes());
  }
  chunk_indexes_ += record(kChunkIndex, Fields()
                                            .integer(chunk_start_)
                                            .integer(chunk_end_)
                                            .integer(at)
                                            .integer<std::uint64_t>(end - at)
                                            .list(offsets)
                                            .integer<std::uint64_t>(file_.size() - end)
                                            .string(kChunkCompression)
                                            .integer<std::uint64_t>(bytes.size())
                                            .integer<std::uint64_t>(chunk_.size())
                                            .bytes());
  ++chunks_;
  chunk_.clear();
  chunk_index_.clear();
  chunk_start_ = chunk_end_ = 0;
}

void McapWriter::attach(std::string_view name, std::string_view media_type, std::uint64_t time, std::string_view data) {
  end_chunk();
  const std::string content = Fields()
                                  .integer(time)
                                  .integer(time)
                                  .string(name)
                                  .string(media_type)
                                  .integer<std::uint64_t>(data.size())
                                  .raw(data)
                                  .bytes();
  const std::string made = record(kAttachment, Fields().raw(content).integer(crc_of(content)).bytes());
  attachment_indexes_ += record(kAttachmentIndex, Fields()
                                                      .integer<std::uint64_t>(file_.size())
                                                      .integer<std::uint64_t>(made.size())
                                                      .integer(time)
                                                      .integer(time)
                                                      .integer<std::uint64_t>(data.size())
                                                      .string(name)
                                                      .string(media_type)
                                                      .bytes());
  file_ += made;
  ++attachments_;
}

void McapWriter::add_metadata(std::string_view name, const std::map<std::string, std::string>& values) {
  end_chunk();
  const std::string made = record(kMetadata, Fields().string(name).strings(values).bytes());
  metadata_indexes_ +=
      record(kMetadataIndex,
             Fields().integer<std::uint64_t>(file_.size()).integer<std::uint64_t>(made.size()).string(name).bytes());
  file_ += made;
  ++metadata_;
}

std::string McapWriter::statistics() const {
  Fields counts;
  for (std::size_t i = 0; i < sequences_.size(); ++i) {
    counts.integer(static_cast<std::uint16_t>(i + 1)).integer<std::uint64_t>(sequences_[i]);
  }
  return record(kStatistics, Fields()
                                 .integer(messages_)
                                 .integer(static_cast<std::uint16_t>(schema_ids_.size()))
                                 .integer(static_cast<std::uint32_t>(sequences_.size()))
                                 .integer(attachments_)
                                 .integer(metadata_)
                                 .integer(chunks_)
                                 .integer(first_time_)
                                 .integer(last_time_)
                                 .list(counts)
                                 .bytes());
}

/// The records that say where data is, again, by kind, and where each kind begins.
std::string McapWriter::summary(std::uint64_t start) {
  const std::array<std::pair<Opcode, std::string>, 6> groups = {{{kSchema, schemas_},
                                                                 {kChannel, channels_},
                                                                 {kStatistics, statistics()},
                                                                 {kChunkIndex, chunk_indexes_},
                                                                 {kAttachmentIndex, attachment_indexes_},
                                                                 {kMetadataIndex, metadata_indexes_}}};
  std::string bytes;
  std::string offsets;
  for (const auto& [opcode, records] : groups) {
    if (records.empty()) continue;
    offsets += record(kSummaryOffset, Fields()
                                          .integer(opcode)
                                          .integer<std::uint64_t>(start + bytes.size())
                                          .integer<std::uint64_t>(records.size())
                                          .bytes());
    bytes += records;
  }
  const std::uint64_t offsets_start = start + bytes.size();
  bytes += offsets;
  // The footer's checksum is of the summary and of the footer up to it.
  constexpr std::uint64_t kFooterSize = 8 + 8 + 4;
  bytes += Fields().integer(kFooter).integer(kFooterSize).integer(start).integer(offsets_start).bytes();
  return bytes + Fields().integer(crc_of(bytes)).bytes();
}

std::string McapWriter::finish() {
  end_chunk();
  file_ += record(kDataEnd, Fields().integer(crc_of(file_)).bytes());
  file_ += summary(file_.size());
  file_ += kMcapMagic;
  return std::move(file_);
}

}  // namespace fencepost::host::exports
