// One line before its fields are read: length, CRC and kind.
#pragma once

#include <cstdint>
#include <string_view>

#include "firmware/record/kinds.hpp"
#include "hal/base/result.hpp"

namespace fencepost::record {

/// A line whose length, CRC and kind are right.
struct Line {
  Kind kind = Kind::kHeader;
  std::string_view fields;      ///< the text after the kind's comma; borrowed from the line
  std::size_t field_count = 0;  ///< 0 only if the kind has no comma after it
};

/// `line` is without its line end.
/// errors: length, crc (also: no or several '*'), kind
base::Result<Line, Reject> open_line(std::string_view line);

/// The format number of an FPHDR whatever its other fields are: another format may have other ones.
/// errors: fields, number, range
base::Result<std::uint32_t, Reject> header_format(const Line& line);

}  // namespace fencepost::record
