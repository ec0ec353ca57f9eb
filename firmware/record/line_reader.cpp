#include "firmware/record/line_reader.hpp"

namespace fencepost::record {

LineOutcome LineReader::count_foreign() {
  ++counts_.foreign;
  return {.use = LineUse::kForeign, .line_number = ++line_number_};
}

LineOutcome LineReader::count_rejected(Reject reason) {
  ++line_number_;
  RejectCount& count = counts_.rejects[static_cast<std::size_t>(reason)];
  if (count.lines++ == 0) count.first_line = line_number_;
  return {.use = LineUse::kRejected, .reject = reason, .line_number = line_number_};
}

LineOutcome LineReader::count_record(Kind kind) {
  ++counts_.records;
  ++counts_.records_by_kind[static_cast<std::size_t>(kind)];
  return {.use = LineUse::kRecord, .kind = kind, .line_number = ++line_number_};
}

void LineReader::note_format(std::string_view line) {
  const base::Result<Line, Reject> opened = open_line(line);
  if (!opened) return;
  if (const base::Result<std::uint32_t, Reject> format = header_format(*opened)) other_format_ = *format;
}

}  // namespace fencepost::record
