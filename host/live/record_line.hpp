// Records as text, for what is printed or written beside a log.
#pragma once

#include <array>
#include <string>

#include "firmware/record/encode.hpp"

namespace fencepost::host {

/// As it stands in a log, "\r\n" included; empty if a field is out of its range.
template <class Record>
std::string record_line(const Record& record) {
  std::array<char, record::kMaxLine> line{};
  return {line.data(), record::encode(record, line)};
}

/// The same without its end.
template <class Record>
std::string record_line_without_end(const Record& record) {
  std::string line = record_line(record);
  if (!line.empty()) line.resize(line.size() - 2);
  return line;
}

}  // namespace fencepost::host
