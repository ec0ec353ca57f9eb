#include "firmware/record/line.hpp"

#include <algorithm>

#include "firmware/record/decimal.hpp"
#include "firmware/record/layout.hpp"
#include "firmware/record/text.hpp"
#include "hal/base/crc16.hpp"

namespace fencepost::record {
namespace {

/// Upper case only, as written.
bool crc_matches(std::string_view digits, std::uint16_t crc) {
  unsigned shift = 4 * kCrcDigits;
  for (const char c : digits) {
    shift -= 4;
    if (c != kUpperHex[(static_cast<unsigned>(crc) >> shift) & 0xFU]) return false;
  }
  return true;
}

}  // namespace

base::Result<Line, Reject> open_line(std::string_view line) {
  if (line.size() > kMaxLine - 1) return Reject::kLength;
  const std::string_view covered = before(line, '*');
  if (covered.empty() || line.size() != covered.size() + 1 + kCrcDigits) return Reject::kCrc;
  const std::string_view body = after(covered, 1);
  if (!crc_matches(after(line, covered.size() + 1), base::crc16(body))) return Reject::kCrc;
  const std::string_view kind_name = before(body, ',');
  for (std::uint8_t kind = 0; kind < kKinds; ++kind) {
    if (line.front() != '$' || kind_name != name(static_cast<Kind>(kind))) continue;
    if (kind_name.size() == body.size()) return Line{static_cast<Kind>(kind), {}, 0};
    const std::string_view fields = after(body, kind_name.size() + 1);
    const auto commas = static_cast<std::size_t>(std::count(fields.begin(), fields.end(), ','));
    return Line{static_cast<Kind>(kind), fields, commas + 1};
  }
  return Reject::kKind;
}

base::Result<std::uint32_t, Reject> header_format(const Line& line) {
  if (line.field_count == 0) return Reject::kFields;
  const auto format = read_decimal(before(line.fields, ','), kCount);
  if (!format) return format.error();
  return static_cast<std::uint32_t>(*format);
}

}  // namespace fencepost::record
