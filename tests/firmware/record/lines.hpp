// Shared by the tests of the record stream: lines made by hand, records in a list.
#pragma once

#include <array>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "firmware/record/encode.hpp"
#include "firmware/record/records.hpp"
#include "hal/base/crc16.hpp"

namespace fencepost::record {

using AnyRecord = std::variant<Header, sensor::CameraIntrinsics, Signature, sensor::OdometrySample, sensor::BlobFrame,
                               Position, ObjectReport, AlertReport, DigestReport, LinkReport, StatusReport, Setting,
                               Heartbeat, CalibrationDoubt, sensor::CarSample, SectorReport, WayReport, SpeedLimit>;

/// "FPODO,..." to "$FPODO,...*CRC", without a line end.
inline std::string sealed(std::string_view body) {
  char crc[8];
  std::snprintf(crc, sizeof crc, "*%04X", static_cast<unsigned>(base::crc16(body)));
  return "$" + std::string(body) + crc;
}

template <class Record>
std::string encoded(const Record& record) {
  std::array<char, kMaxLine> line{};
  return {line.data(), encode(record, line)};
}

inline std::string encoded(const AnyRecord& record) {
  return std::visit([](const auto& r) { return encoded(r); }, record);
}

/// Keeps every record in order.
struct Recorder {
  std::vector<AnyRecord> records;
  template <class Record>
  void accept(const Record& record) {
    records.emplace_back(record);
  }
};

}  // namespace fencepost::record

namespace fencepost::test {

/// With its end. Throws std::runtime_error if it is outside the range of the stream.
template <class Record>
std::string line_of(const Record& record) {
  std::string line = record::encoded(record);
  if (line.empty()) throw std::runtime_error("a record is outside the range of the stream");
  return line;
}

/// The log of a robot that had the setting before it started: a line after the header. Throws std::runtime_error.
inline std::string with_setting(std::string log, const record::Setting& setting) {
  if (!log.starts_with("$FPHDR")) throw std::runtime_error("a log has to begin with its header");
  return log.insert(log.find('\n') + 1, line_of(setting));
}

}  // namespace fencepost::test
