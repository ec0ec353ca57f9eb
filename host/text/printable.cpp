#include "host/text/printable.hpp"

namespace fencepost::host {
namespace {

constexpr char kInstead = '?';

void replace_before(std::string& text, std::size_t end, int count) {
  for (std::size_t i = end - static_cast<std::size_t>(count); i < end; ++i) text[i] = kInstead;
}

}  // namespace

char PrintableBytes::next(char c) {
  const auto byte = static_cast<std::uint8_t>(c);
  broken_off_ = 0;
  if (missing_ > 0 && byte >= low_ && byte <= high_) {
    low_ = 0x80;
    high_ = 0xBF;
    --missing_;
    ++begun_;
    character_ = character_ << 8U | byte;
    return missing_ == 0 ? ended(c) : c;
  }
  broken_off_ = begun();
  return begin(byte);
}

// Explicit formatting characters of the bidirectional algorithm (Unicode Standard Annex 9): with them "gol.exe" would
// be shown as "exe.log".
char PrintableBytes::ended(char c) {
  const auto within = [this](std::uint32_t low, std::uint32_t high) { return character_ >= low && character_ <= high; };
  const bool turns = within(0xE2'80'8E, 0xE2'80'8F) || within(0xE2'80'AA, 0xE2'80'AE) ||
                     within(0xE2'81'A6, 0xE2'81'A9) || character_ == 0xD8'9C;
  if (!turns) return c;
  broken_off_ = begun_ - 1;
  return kInstead;
}

// Table 3-7 of the Unicode standard, but for C2 80 to C2 9F: those are the C1 control characters.
char PrintableBytes::begin(std::uint8_t byte) {
  begun_ = 1;
  character_ = byte;
  missing_ = 0;
  low_ = 0x80;
  high_ = 0xBF;
  if (byte < 0x80) return byte < 0x20 || byte == 0x7F ? kInstead : static_cast<char>(byte);
  if (byte < 0xC2 || byte > 0xF4) return kInstead;
  missing_ = byte < 0xE0 ? 1 : byte < 0xF0 ? 2 : 3;
  if (byte == 0xC2 || byte == 0xE0) low_ = 0xA0;
  if (byte == 0xED) high_ = 0x9F;
  if (byte == 0xF0) low_ = 0x90;
  if (byte == 0xF4) high_ = 0x8F;
  return static_cast<char>(byte);
}

std::string printable(std::string_view text) {
  std::string clean(text);
  PrintableBytes bytes;
  for (std::size_t i = 0; i < clean.size(); ++i) {
    clean[i] = bytes.next(clean[i]);
    replace_before(clean, i, bytes.broken_off());
  }
  replace_before(clean, clean.size(), bytes.begun());
  return clean;
}

}  // namespace fencepost::host
