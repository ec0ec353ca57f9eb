// Lines to records, one line at a time. What depends on earlier lines (time order, camera size) is LineReader's.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <type_traits>

#include "firmware/record/field_reader.hpp"
#include "firmware/record/kinds.hpp"
#include "firmware/record/layout.hpp"
#include "firmware/record/line.hpp"
#include "hal/base/result.hpp"

namespace fencepost::record {

template <class S, class Record>
concept Takes = requires(S sink, const Record& record) {
  sink.accept(record);
};

template <class S, class... Records>
constexpr bool takes_all(RecordList<Records...> /*list*/) {
  return (Takes<S, Records> && ...);
}

/// Takes each kind of record by `accept(const X&)`. One that wants few kinds adds a template for the rest:
/// `template <class X> void accept(const X&) {}`. With `template <class X> static constexpr bool wants()` the fields of
/// unwanted kinds are not read. A line of such a kind is then no fault if its CRC is right.
template <class S>
concept RecordSink = takes_all<S>(AllRecords{});

struct DecodeOptions {
  /// On a live console: when the line arrived, robot's clock. Stamps an FPODO whose t is empty; without it, such a
  /// record is rejected (`number`).
  std::optional<base::Time> arrival;
};

/// Reads the fields of an opened line of the record's kind; `record` is meaningful only without a Reject.
/// errors: fields, number (cannot be read), range (can be read, is not allowed), format (FPHDR)
template <RecordType Record>
std::optional<Reject> read(const Line& line, const DecodeOptions& options, Record& record) {
  if constexpr (std::is_same_v<Record, Header>) {
    const base::Result<std::uint32_t, Reject> format = header_format(line);
    if (format && *format != kStreamFormat) return Reject::kFormat;
  }
  FieldReader fields(line, options.arrival);
  if (!fields.fault()) walk(fields, record);
  return fields.fault();
}

template <class Sink, class Record>
constexpr bool wants() {
  if constexpr (requires { Sink::template wants<Record>(); }) return Sink::template wants<Record>();
  return true;
}

template <class Record, RecordSink Sink>
requires(!wants<Sink, Record>()) base::Result<Kind, Reject> deliver(const Line& line, const DecodeOptions& /*options*/,
                                                                    Sink& /*sink*/) {
  return line.kind;
}
template <class Record, RecordSink Sink>
base::Result<Kind, Reject> deliver(const Line& line, const DecodeOptions& options, Sink& sink) {
  Record record;
  if (const std::optional<Reject> reject = read(line, options, record)) return *reject;
  sink.accept(record);
  return line.kind;
}

template <RecordSink Sink, class... Records>
base::Result<Kind, Reject> deliver_one_of(RecordList<Records...> /*list*/, const Line& line,
                                          const DecodeOptions& options, Sink& sink) {
  base::Result<Kind, Reject> result = Reject::kKind;
  static_cast<void>(((line.kind == kKindOf<Records> && (result = deliver<Records>(line, options, sink), true)) || ...));
  return result;
}

/// Delivers the line's record to `sink`, or says why not.
/// errors: length, crc, kind, fields, number, range, format
template <RecordSink Sink>
base::Result<Kind, Reject> decode(std::string_view line, const DecodeOptions& options, Sink& sink) {
  const base::Result<Line, Reject> opened = open_line(line);
  if (!opened) return opened.error();
  return deliver_one_of(AllRecords{}, *opened, options, sink);
}

}  // namespace fencepost::record
