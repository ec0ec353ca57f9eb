#include "firmware/record/field_writer.hpp"

#include <algorithm>

#include "firmware/record/text.hpp"
#include "hal/base/crc16.hpp"

namespace fencepost::record {

FieldWriter::FieldWriter(Kind kind, std::span<char> line) : line_(line.first(std::min(line.size(), kMaxLine))) {
  put('$');
  put(name(kind));
}

void FieldWriter::number(std::int64_t raw, const NumberField& field) {
  put(',');
  require(raw >= field.min && raw <= field.max);
  if (void_) return;
  char digits[kMaxDecimal];
  put({digits, write_decimal(raw, field.decimals, digits)});
}

void FieldWriter::short_number(std::int32_t raw, const NumberField& field) { number(std::int64_t{raw}, field); }

void FieldWriter::text(const sensor::Text& text) {
  put(',');
  for (const char c : text.view()) {
    if (stands_for_itself(c)) {
      put(c);
    } else {
      put(kEscape);
      put_hex(static_cast<std::uint8_t>(c), 2, kUpperHex);
    }
  }
}

void FieldWriter::colour(sensor::Rgb rgb) {
  put(',');
  for (const std::uint8_t part : {rgb.red, rgb.green, rgb.blue}) put_hex(part, 2, kLowerHex);
}

void FieldWriter::digest(std::uint64_t value) {
  put(',');
  put_hex(value, kDigestDigits, kLowerHex);
}

std::size_t FieldWriter::finish() {
  if (void_) return 0;
  const std::uint16_t crc = base::crc16(after({line_.data(), size_}, 1));
  put('*');
  put_hex(crc, kCrcDigits, kUpperHex);
  put("\r\n");
  return void_ ? 0 : size_;
}

void FieldWriter::put(char c) {
  require(size_ < line_.size());
  if (!void_) line_[size_++] = c;
}

void FieldWriter::put(std::string_view characters) {
  for (const char c : characters) put(c);
}

void FieldWriter::put_hex(std::uint64_t value, unsigned digits, std::string_view alphabet) {
  for (unsigned shift = 4 * digits; shift != 0; shift -= 4) put(alphabet[(value >> (shift - 4)) & 0xFU]);
}

}  // namespace fencepost::record
