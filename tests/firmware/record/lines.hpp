// What the tests of the record stream share: lines made by hand, records in a list.
#pragma once

#include <array>
#include <cstdio>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "firmware/record/encode.hpp"
#include "firmware/record/records.hpp"
#include "hal/base/crc16.hpp"

namespace fencepost::record {

using AnyRecord = std::variant<Header, sensor::CameraIntrinsics, Signature, sensor::OdometrySample, sensor::BlobFrame,
                               Position, ObjectReport, AlertReport, DigestReport, LinkReport, StatusReport, Setting>;

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
