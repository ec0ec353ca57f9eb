// Whole lines in stream order: decides foreign, accepted or rejected, and counts. The console uses this directly.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "firmware/record/counts.hpp"
#include "firmware/record/decode.hpp"
#include "firmware/record/run_rules.hpp"

namespace fencepost::record {

enum class LineUse : std::uint8_t { kRecord, kForeign, kRejected };

/// The outcome of one line.
struct LineOutcome {
  LineUse use = LineUse::kForeign;
  Kind kind = Kind::kHeader;      ///< of a record
  Reject reject = Reject::kCrc;   ///< of a rejected line
  std::uint32_t line_number = 0;  ///< 1-based
  friend constexpr bool operator==(const LineOutcome&, const LineOutcome&) = default;
};

class LineReader {
 public:
  /// One line without its line end ("\n" or "\r\n"). At most one record goes to `sink`.
  /// errors, in the outcome: all of Reject but truncated
  template <RecordSink Sink>
  LineOutcome take_line(std::string_view line, Sink& sink, const DecodeOptions& options = {}) {
    if (!line.starts_with(kRecordStart)) return count_foreign();
    Gate<Sink> gate{rules_, sink, std::nullopt};
    const base::Result<Kind, Reject> result = decode(line, options, gate);
    if (!result) {
      if (result.error() == Reject::kFormat) note_format(line);
      return count_rejected(result.error());
    }
    return gate.reject ? count_rejected(*gate.reject) : count_record(*result);
  }

  /// Counts a line that never came whole: it was too long, or unfinished at the end of the stream.
  LineOutcome count_foreign();
  LineOutcome count_rejected(Reject reason);

  [[nodiscard]] const Counts& counts() const { return counts_; }
  /// Lines seen so far: the 1-based number of the last one.
  [[nodiscard]] std::uint32_t line_number() const { return line_number_; }
  /// Set by the last FPHDR that was rejected because of its format; reading a log should end there.
  [[nodiscard]] std::optional<std::uint32_t> other_format() const { return other_format_; }

 private:
  /// Lets a record through to the sink if the run's rules allow it.
  template <class Sink>
  struct Gate {
    RunRules& rules;
    Sink& sink;
    std::optional<Reject> reject;

    template <class Record>
    void accept(const Record& record) {
      reject = rules.admit(record);
      if (!reject) sink.accept(record);
    }
  };

  LineOutcome count_record(Kind kind);
  void note_format(std::string_view line);

  RunRules rules_;
  Counts counts_;
  std::uint32_t line_number_ = 0;
  std::optional<std::uint32_t> other_format_;
};

}  // namespace fencepost::record
