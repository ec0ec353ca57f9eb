// Lines to records, one line at a time. What depends on earlier lines (time order, camera size) is LineReader's.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "firmware/record/kinds.hpp"
#include "firmware/record/records.hpp"
#include "hal/base/result.hpp"

namespace fencepost::record {

/// Takes each kind of record by `accept(const X&)`. One that wants few kinds adds a template for the rest:
/// `template <class X> void accept(const X&) {}`. If it also has `template <class X> static constexpr bool wants()`,
/// the fields of what it does not want are not even read: a line of such a kind is no fault if its CRC is right.
template <class S>
concept RecordSink = requires(S sink, const Header& header, const sensor::CameraIntrinsics& camera,
                              const Signature& signature, const sensor::OdometrySample& odometry,
                              const sensor::BlobFrame& frame, const Position& position, const ObjectReport& object,
                              const AlertReport& alert, const DigestReport& digest, const LinkReport& link,
                              const StatusReport& status, const Setting& setting) {
  sink.accept(header), sink.accept(camera), sink.accept(signature), sink.accept(odometry), sink.accept(frame);
  sink.accept(position), sink.accept(object), sink.accept(alert), sink.accept(digest), sink.accept(link);
  sink.accept(status), sink.accept(setting);
};

struct DecodeOptions {
  /// On a live console: when the line arrived, robot's clock. Stamps an FPODO whose t is empty; without it, such a
  /// record is rejected (`number`).
  std::optional<base::Time> arrival;
};

/// A line whose length, CRC and kind are right.
struct Line {
  Kind kind = Kind::kHeader;
  std::string_view fields;      ///< what follows the kind's comma; borrowed from the line
  std::size_t field_count = 0;  ///< 0 only if the kind has no comma after it
};

/// `line` is without its line end.
/// errors: length, crc (also: no or several '*'), kind
base::Result<Line, Reject> open_line(std::string_view line);

/// The format number of an FPHDR whatever its other fields are: another format may have other ones.
/// errors: fields, number, range
base::Result<std::uint32_t, Reject> header_format(const Line& line);

/// Read the fields of an opened line of the matching kind; `record` is meaningful only without a Reject.
/// errors: fields, number (cannot be read), range (can be read, is not allowed), format (FPHDR)
std::optional<Reject> read(const Line& line, const DecodeOptions& options, Header& record);
std::optional<Reject> read(const Line& line, const DecodeOptions& options, sensor::CameraIntrinsics& record);
std::optional<Reject> read(const Line& line, const DecodeOptions& options, Signature& record);
std::optional<Reject> read(const Line& line, const DecodeOptions& options, sensor::OdometrySample& record);
std::optional<Reject> read(const Line& line, const DecodeOptions& options, sensor::BlobFrame& record);
std::optional<Reject> read(const Line& line, const DecodeOptions& options, Position& record);
std::optional<Reject> read(const Line& line, const DecodeOptions& options, ObjectReport& record);
std::optional<Reject> read(const Line& line, const DecodeOptions& options, AlertReport& record);
std::optional<Reject> read(const Line& line, const DecodeOptions& options, DigestReport& record);
std::optional<Reject> read(const Line& line, const DecodeOptions& options, LinkReport& record);
std::optional<Reject> read(const Line& line, const DecodeOptions& options, StatusReport& record);
std::optional<Reject> read(const Line& line, const DecodeOptions& options, Setting& record);

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

/// Delivers the line's record to `sink`, or says why not.
/// errors: length, crc, kind, fields, number, range, format
template <RecordSink Sink>
base::Result<Kind, Reject> decode(std::string_view line, const DecodeOptions& options, Sink& sink) {
  const base::Result<Line, Reject> opened = open_line(line);
  if (!opened) return opened.error();
  switch (opened->kind) {
    case Kind::kHeader: return deliver<Header>(*opened, options, sink);
    case Kind::kCamera: return deliver<sensor::CameraIntrinsics>(*opened, options, sink);
    case Kind::kSignature: return deliver<Signature>(*opened, options, sink);
    case Kind::kOdometry: return deliver<sensor::OdometrySample>(*opened, options, sink);
    case Kind::kFrame: return deliver<sensor::BlobFrame>(*opened, options, sink);
    case Kind::kPosition: return deliver<Position>(*opened, options, sink);
    case Kind::kObject: return deliver<ObjectReport>(*opened, options, sink);
    case Kind::kAlert: return deliver<AlertReport>(*opened, options, sink);
    case Kind::kDigest: return deliver<DigestReport>(*opened, options, sink);
    case Kind::kLink: return deliver<LinkReport>(*opened, options, sink);
    case Kind::kStatus: return deliver<StatusReport>(*opened, options, sink);
    case Kind::kSetting: return deliver<Setting>(*opened, options, sink);
  }
  return Reject::kKind;
}

}  // namespace fencepost::record
