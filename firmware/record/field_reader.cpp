#include "firmware/record/field_reader.hpp"

#include "firmware/record/text.hpp"
#include "hal/base/vectors.hpp"

namespace fencepost::record {
namespace {

/// Two hex digits of either case, or -1.
int hex_byte(std::string_view digits) {
  if (digits.size() < 2) return -1;
  const int high = hex_value(digits[0]);
  const int low = hex_value(digits[1]);
  return high < 0 || low < 0 ? -1 : high * 16 + low;
}

}  // namespace

FieldReader::FieldReader(const Line& line, std::optional<base::Time> arrival)
    : rest_(line.fields), left_(line.field_count), arrival_(arrival) {
  const KindInfo& kind = info(line.kind);
  const bool too_many = !kind.list && left_ > std::size_t{kind.fields} + kind.more;
  if (left_ < kind.fields || too_many) fail(Reject::kFields);
}

std::string_view FieldReader::next() {
  const std::string_view field = before(rest_, ',');
  rest_ = after(rest_, field.size() + 1);
  if (left_ != 0) --left_;
  return field;
}

bool FieldReader::skip_empty() {
  const bool empty = rest_.empty() || rest_.front() == ',';
  if (empty) next();
  return empty;
}

std::int64_t FieldReader::next_number(const NumberField& field) {
  // A desk has room for a shorter way.
  if constexpr (base::kVectors) {
    if (const std::optional<std::int64_t> plain = read_plain(rest_, field)) {
      if (left_ != 0) --left_;
      return *plain;
    }
  }
  const base::Result<std::int64_t, Reject> raw = read_decimal(next(), field);
  if (raw) return *raw;
  fail(raw.error());
  return 0;
}

void FieldReader::time_or_arrival(base::Time& t, const NumberField& field) {
  if (!arrival_ || !skip_empty()) return number(t.raw, field);
  t = *arrival_;
  require(t.raw >= field.min && t.raw <= field.max);
}

void FieldReader::text(sensor::Text& text) {
  text = {};
  std::string_view field = next();
  while (!field.empty()) {
    char c = field.front();
    std::size_t used = 1;
    if (c == kEscape) {
      const int byte = hex_byte(after(field, 1));
      if (byte < 0) return fail(Reject::kNumber);
      c = static_cast<char>(byte);
      used = 3;
    } else if (!stands_for_itself(c)) {
      return fail(Reject::kNumber);
    }
    if (!text.push_back(c)) return fail(Reject::kRange);
    field.remove_prefix(used);
  }
}

void FieldReader::colour(sensor::Rgb& rgb) {
  const std::string_view field = next();
  if (field.size() != 6) return fail(Reject::kNumber);
  std::size_t at = 0;
  for (std::uint8_t* part : {&rgb.red, &rgb.green, &rgb.blue}) {
    const int byte = hex_byte(after(field, at));
    if (byte < 0) return fail(Reject::kNumber);
    *part = static_cast<std::uint8_t>(byte);
    at += 2;
  }
}

void FieldReader::colour_or_empty(std::optional<sensor::Rgb>& rgb) {
  rgb.reset();
  if (skip_empty()) return;
  rgb.emplace();
  colour(*rgb);
}

void FieldReader::digest(std::uint64_t& value) {
  const std::string_view field = next();
  if (field.size() != kDigestDigits) return fail(Reject::kNumber);
  value = 0;
  for (const char c : field) {
    const std::size_t digit = kLowerHex.find(c);
    if (digit == std::string_view::npos) return fail(Reject::kNumber);
    value = value * 16 + digit;
  }
}

void FieldReader::fail(Reject reason) {
  if (!fault_) fault_ = reason;
}

}  // namespace fencepost::record
