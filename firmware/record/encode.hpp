// Records to lines. Byte-reproducible: the same record gives the same bytes on every target.
#pragma once

#include <cstddef>
#include <span>

#include "firmware/record/field_writer.hpp"
#include "firmware/record/kinds.hpp"
#include "firmware/record/layout.hpp"

namespace fencepost::record {

/// Writes the whole line, CRC and "\r\n" included, and returns its length; kMaxLine characters hold any line.
/// Returns 0 if the line does not fit into `line` or into kMaxLine, or if a value is outside the range of its field.
/// Thus a record that a reader would reject is never written. `line` then holds nothing of use.
template <RecordType Record>
[[nodiscard]] std::size_t encode(const Record& record, std::span<char> line) {
  FieldWriter fields(kKindOf<Record>, line);
  walk(fields, record);
  return fields.finish();
}

}  // namespace fencepost::record
