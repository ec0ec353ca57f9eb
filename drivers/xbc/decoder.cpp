#include "drivers/xbc/decoder.hpp"

#include <span>

#include "drivers/serial/largest_first.hpp"

namespace fencepost::xbc {
namespace {

constexpr std::int32_t kBlobsAChannel = 32;

/// Value of an upper-case hex digit, or 16.
unsigned hex_digit(char c) {
  if (c >= '0' && c <= '9') return static_cast<unsigned>(c - '0');
  if (c >= 'A' && c <= 'F') return static_cast<unsigned>(c - 'A' + 10);
  return 16;
}

/// The text after its first characters; string_view's own substr could throw.
std::string_view without_first(std::string_view text, std::size_t characters) {
  text.remove_prefix(characters);
  return text;
}

/// The text between `$` and `*`, if the checksum after it is right; else empty.
std::string_view opened(std::string_view line) {
  constexpr std::size_t kTail = 3;
  if (line.size() < 2 + kTail || line[line.size() - kTail] != '*') return {};
  const std::string_view body(line.data() + 1, line.size() - kTail - 1);
  unsigned sum = 0;
  for (const char c : body) sum ^= static_cast<unsigned char>(c);
  const unsigned high = hex_digit(line[line.size() - 2]);
  const unsigned low = hex_digit(line[line.size() - 1]);
  return high < 16 && low < 16 && sum == 16 * high + low ? body : std::string_view{};
}

/// Takes `c` off the front of the text, if it is there.
bool take(char c, std::string_view& text) {
  const bool there = text.starts_with(c);
  if (there) text.remove_prefix(1);
  return there;
}

/// Exactly as many integers as `out` has, each after one space; at most nine digits.
bool read_numbers(std::string_view text, std::span<std::int32_t> out) {
  constexpr int kMaxDigits = 9;
  for (std::int32_t& number : out) {
    if (!take(' ', text)) return false;
    const bool negative = take('-', text);
    int digits = 0;
    number = 0;
    for (; digits < kMaxDigits && !text.empty() && text[0] >= '0' && text[0] <= '9'; ++digits) {
      number = 10 * number + (text[0] - '0');
      text.remove_prefix(1);
    }
    if (digits == 0) return false;
    if (negative) number = -number;
  }
  return text.empty();
}

bool between(std::int32_t low, std::int32_t value, std::int32_t high) { return low <= value && value <= high; }

}  // namespace

Event Decoder::feed(std::uint8_t byte, base::Time now) {
  const char c = static_cast<char>(byte);
  if (c == '$') {
    if (in_line_) {
      ++counts_.damaged;
      abandon();
    }
    in_line_ = true;
    size_ = 0;
    line_t_ = now;
  }
  if (c == '\n') return end_line();
  if (!in_line_) return Event::kNone;
  if (size_ == kLine) {
    in_line_ = false;
    ++counts_.damaged;
    abandon();
    return Event::kNone;
  }
  line_[size_++] = c;
  return Event::kNone;
}

Event Decoder::end_line() {
  if (!in_line_) return Event::kNone;
  in_line_ = false;
  std::string_view line(line_.data(), size_);
  if (line.back() == '\r') line.remove_suffix(1);
  const std::string_view body = opened(line);
  if (!body.empty()) return obey(body);
  ++counts_.damaged;
  abandon();
  return Event::kNone;
}

Event Decoder::obey(std::string_view body) {
  switch (body[0]) {
    case 'F': return begin_frame(without_first(body, 1));
    case 'B': return add_blob(without_first(body, 1));
    case 'E': return end_frame(without_first(body, 1));
    case 'V': break;
    default: return impossible();
  }
  constexpr std::string_view kVersionText = "V XBCL";
  std::array<std::int32_t, 1> number{};
  if (!body.starts_with(kVersionText)) return impossible();
  if (!read_numbers(without_first(body, kVersionText.size()), number)) return impossible();
  version_ = number[0];
  return Event::kVersion;
}

Event Decoder::begin_frame(std::string_view fields) {
  abandon();
  std::array<std::int32_t, 2> number{};
  constexpr auto kMax = static_cast<std::int32_t>(kChannels) * kBlobsAChannel;
  if (!read_numbers(fields, number) || number[0] < 0 || !between(0, number[1], kMax)) return impossible();
  building_ = true;
  announced_ = number[1];
  received_ = 0;
  over_ = 0;
  next_ = {line_t_, static_cast<std::uint32_t>(number[0]), {}};
  return Event::kNone;
}

Event Decoder::add_blob(std::string_view fields) {
  if (!building_) return Event::kNone;  // of a frame that was given up
  std::array<std::int32_t, 11> n{};
  if (!read_numbers(fields, n)) return impossible();
  const auto& [channel, index, x, y, size, confidence, left, top, right, bottom, angle] = n;
  constexpr std::int32_t kPiMilliradians = 3'142;
  const bool possible = between(0, channel, kChannels - 1) && between(0, index, kBlobsAChannel - 1) &&
                        between(0, left, x) && between(x, right, kWidth - 1) && between(0, top, y) &&
                        between(y, bottom, kHeight - 1) && between(1, size, 32'767) && between(0, confidence, 100) &&
                        between(-kPiMilliradians, angle, kPiMilliradians);
  if (!possible) return impossible();
  sensor::Blob blob;
  blob.signature = signatures_[static_cast<std::size_t>(channel)];
  blob.x1 = static_cast<std::int16_t>(left);
  blob.y1 = static_cast<std::int16_t>(top);
  blob.x2 = static_cast<std::int16_t>(right);
  blob.y2 = static_cast<std::int16_t>(bottom);
  blob.cx = {10 * x};
  blob.cy = {10 * y};
  // 32767 is where an int of the XBC ends: then the box says more.
  blob.pixels = size == 32'767 ? 0U : static_cast<std::uint32_t>(size);
  ++received_;
  if (!serial::insert_largest_first(next_, blob)) ++over_;
  return Event::kNone;
}

Event Decoder::end_frame(std::string_view fields) {
  if (!building_) return Event::kNone;
  std::array<std::int32_t, 1> number{};
  if (!read_numbers(fields, number)) return impossible();
  if (static_cast<std::uint32_t>(number[0]) != next_.frame || received_ != announced_) {
    abandon();
    return Event::kNone;
  }
  building_ = false;
  counts_.dropped += over_;
  frame_ = next_;
  return Event::kFrame;
}

Event Decoder::impossible() {
  ++counts_.impossible;
  abandon();
  return Event::kNone;
}

void Decoder::abandon() {
  if (building_) ++counts_.incomplete;
  building_ = false;
}

}  // namespace fencepost::xbc
