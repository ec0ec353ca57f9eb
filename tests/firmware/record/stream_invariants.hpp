// Invariants of the stream reader, for any bytes whatever; a violation traps.
#pragma once

#include <algorithm>
#include <numeric>
#include <string>
#include <string_view>

#include "firmware/record/stream_reader.hpp"
#include "hal/base/check.hpp"
#include "tests/firmware/record/lines.hpp"

namespace fencepost::record {

/// Each accepted record, written and read again, is the same record; written once more, the same bytes.
struct ReencodingSink {
  std::uint32_t records = 0;

  template <class Record>
  void accept(const Record& record) {
    ++records;
    const std::string line = encoded(record);
    if (line.empty()) {
      // A line with few decimals may be too long once it has all of them; only the kind with a list gets that long.
      if constexpr (std::same_as<Record, sensor::BlobFrame>) {
        FENCEPOST_CHECK(record.blobs.size() > 12);
      } else {
        FENCEPOST_CHECK(false);
      }
      return;
    }
    Recorder again;
    FENCEPOST_CHECK(decode(std::string_view(line).substr(0, line.size() - 2), {}, again).ok());
    FENCEPOST_CHECK(again.records.size() == 1 && again.records[0] == AnyRecord(record));
    FENCEPOST_CHECK(encoded(again.records[0]) == line);
  }
};

inline void check_counts(const StreamReader& reader, std::size_t lines, std::uint32_t delivered) {
  const Counts& counts = reader.counts();
  FENCEPOST_CHECK(reader.line_number() == lines);
  FENCEPOST_CHECK(counts.records + counts.foreign + counts.rejected() == lines);
  FENCEPOST_CHECK(counts.records == delivered);
  FENCEPOST_CHECK(counts.records ==
                  std::accumulate(counts.records_by_kind.begin(), counts.records_by_kind.end(), std::uint32_t{0}));
  for (const RejectCount& reject : counts.rejects) {
    FENCEPOST_CHECK(reject.first_line <= lines && (reject.first_line == 0) == (reject.lines == 0));
  }
}

/// Reads `bytes` to their end in a buffer between canaries; then shows that good records after them still arrive.
/// Returns the counts at the end of `bytes`.
inline Counts check_stream_invariants(std::string_view bytes) {
  constexpr std::size_t kGuard = 16;
  constexpr char kCanary = '\x5A';
  std::array<char, StreamReader::kBuffer + 2 * kGuard> memory{};
  memory.fill(kCanary);
  StreamReader reader(std::span<char>(memory).subspan(kGuard, StreamReader::kBuffer));
  ReencodingSink sink;
  reader.push(bytes, sink);
  const auto line_ends = static_cast<std::size_t>(std::count(bytes.begin(), bytes.end(), '\n'));
  const bool unfinished = !bytes.empty() && bytes.back() != '\n';
  FENCEPOST_CHECK(reader.finish().has_value() == unfinished);
  const std::size_t lines = line_ends + (unfinished ? 1U : 0U);
  check_counts(reader, lines, sink.records);
  const Counts at_end = reader.counts();

  reader.push(std::string(bytes.substr(bytes.rfind('\n') + 1)) + "\n", sink);  // the unfinished line, now finished
  const std::uint32_t before = sink.records;
  reader.push(encoded(Header{}) + encoded(sensor::OdometrySample{}) + encoded(sensor::BlobFrame{}), sink);
  FENCEPOST_CHECK(sink.records == before + 3);
  check_counts(reader, lines + 4, sink.records);

  const auto intact = [](char c) { return c == kCanary; };
  FENCEPOST_CHECK(std::all_of(memory.begin(), memory.begin() + kGuard, intact));
  FENCEPOST_CHECK(std::all_of(memory.end() - kGuard, memory.end(), intact));
  return at_end;
}

}  // namespace fencepost::record
