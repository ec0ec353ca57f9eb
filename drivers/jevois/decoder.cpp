#include "drivers/jevois/decoder.hpp"

#include <algorithm>

#include "drivers/serial/largest_first.hpp"

namespace fencepost::jevois {
namespace {

constexpr std::int32_t kHalfWidth = 100'000;  // in hundredths of a standardized coordinate
constexpr std::int32_t kHalfHeight = 75'000;  // of a picture of 4:3
// Polygons' numbers, with a count before them.
constexpr std::size_t kMaxNumbers = 33;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// The next word, taken off the front of `text`; words are separated by one or more spaces.
std::string_view next_word(std::string_view& text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  std::size_t end = 0;
  while (end < text.size() && text[end] != ' ') ++end;
  const std::string_view word(text.data(), end);
  text.remove_prefix(end);
  return word;
}

std::optional<std::uint32_t> whole_number(std::string_view word) {
  constexpr std::size_t kMaxDigits = 9;
  if (word.empty() || word.size() > kMaxDigits) return std::nullopt;
  std::uint32_t value = 0;
  for (const char c : word) {
    if (!is_digit(c)) return std::nullopt;
    value = 10 * value + static_cast<std::uint32_t>(c - '0');
  }
  return value;
}

/// In hundredths; further decimals are dropped. At most 9999 before the point: no picture has more.
std::optional<std::int32_t> hundredths(std::string_view word) {
  const bool negative = !word.empty() && word.front() == '-';
  if (negative) word.remove_prefix(1);
  std::size_t at = 0;
  std::int32_t value = 0;
  while (at < word.size() && is_digit(word[at]) && at < 4) value = 10 * value + (word[at++] - '0');
  if (at == 0) return std::nullopt;
  value *= 100;
  if (at < word.size()) {
    if (word[at++] != '.' || at == word.size()) return std::nullopt;
    for (std::int32_t place = 10; at < word.size(); ++at, place /= 10) {
      if (!is_digit(word[at])) return std::nullopt;
      value += place * (word[at] - '0');
    }
  }
  return negative ? -value : value;
}

bool has_one_decimal(std::string_view word) { return word.size() > 2 && word[word.size() - 2] == '.'; }

/// `123`, `12:34:56`, `123/12:34:56` or `123/2020-01-31/12:34:56` before a message.
bool is_stamp(std::string_view word) {
  const auto fits = [](char c) { return is_digit(c) || c == ':' || c == '/' || c == '-'; };
  return !word.empty() && is_digit(word.front()) && std::all_of(word.begin(), word.end(), fits);
}

/// The frame's number, where the stamp begins with one.
std::optional<std::uint32_t> number_of(std::string_view stamp) {
  std::size_t end = 0;
  while (end < stamp.size() && is_digit(stamp[end])) ++end;
  if (end < stamp.size() && stamp[end] != '/') return std::nullopt;
  return whole_number(std::string_view(stamp.data(), end));
}

/// Answers and log lines of others, which come between messages.
bool is_talk(std::string_view word) {
  constexpr std::array<std::string_view, 7> kTalk = {"OK", "ERR", "ALIVE", "INF", "DBG", "FTL", "TRC"};
  return std::find(kTalk.begin(), kTalk.end(), word) != kTalk.end();
}

/// Nearest of what lies in the picture: `edge` in hundredths from its middle, to a part of `pixels`.
std::int32_t edge_pixels(std::int32_t edge, std::int32_t half, std::int32_t pixels) {
  const std::int64_t from_first = std::clamp<std::int32_t>(edge + half, 0, 2 * half);
  return static_cast<std::int32_t>((from_first * pixels + half) / (2 * half));
}

}  // namespace

Event Decoder::feed(std::uint8_t byte, base::Time now) {
  const char c = static_cast<char>(byte);
  if (c == '\n' || c == '\r') return end_line();
  if (size_ == 0) line_t_ = now;
  if (size_ == kLine) {
    too_long_ = true;
    return Event::kNone;
  }
  line_[size_++] = c;
  return Event::kNone;
}

Event Decoder::end_line() {
  std::string_view line(line_.data(), size_);
  size_ = 0;
  if (too_long_) {
    too_long_ = false;
    return refuse(counts_.damaged);
  }
  if (line.empty()) return Event::kNone;
  std::string_view rest = line;
  std::string_view word = next_word(rest);
  std::optional<std::uint32_t> stamp;
  if (is_stamp(word)) {
    stamp = number_of(word);
    line = rest;
    word = next_word(rest);
  }
  if (is_talk(word)) return Event::kLine;
  if (word == "MARK") return mark(next_word(rest), stamp);
  return message(line);
}

Event Decoder::mark(std::string_view which, std::optional<std::uint32_t> stamp) {
  if (which == "START") {
    if (building_) ++counts_.incomplete;
    building_ = true;
    stamp_ = stamp;
    over_ = 0;
    as_told_ = stamp.has_value();
    next_ = {line_t_, stamp ? *stamp : frame_.frame + 1, {}};
    return Event::kLine;
  }
  if (which != "STOP") return refuse(counts_.damaged);
  if (!building_) return Event::kLine;
  building_ = false;
  if (stamp != stamp_) {
    ++counts_.incomplete;
    return Event::kLine;
  }
  counts_.dropped += over_;
  frame_ = next_;
  return Event::kFrame;
}

Event Decoder::message(std::string_view rest) {
  const std::string_view kind = next_word(rest);
  const bool known = kind.size() == 2 && std::string_view("TNDF").find(kind[0]) != std::string_view::npos;
  if (!known || std::string_view("123O").find(kind[1]) == std::string_view::npos) return refuse(counts_.damaged);
  if (kind[1] != '2' || kind[0] == 'T') {
    (void)refuse(counts_.unused);
    return Event::kLine;
  }
  const std::string_view id = next_word(rest);
  base::FixedVector<std::int32_t, kMaxNumbers> numbers;
  std::string_view word = next_word(rest);
  for (std::optional<std::int32_t> n = hundredths(word); n && numbers.push_back(*n); n = hundredths(word)) {
    as_told_ = as_told_ && has_one_decimal(word);
    word = next_word(rest);
  }
  std::span<const std::int32_t> n = numbers.view();
  if (kind[0] == 'N') {
    if (n.size() != 4 || !word.empty() || n[2] <= 0 || n[3] <= 0) return refuse(counts_.impossible);
    const std::array<std::int32_t, 4> edges = {n[0] - n[2] / 2, n[1] - n[3] / 2, n[0] + n[2] / 2, n[1] + n[3] / 2};
    return add(id, edges);
  }
  if (n.size() % 2 == 1) {
    if (static_cast<std::size_t>(n[0]) != 100 * (n.size() / 2)) return refuse(counts_.impossible);
    n = n.subspan(1);
  }
  if (n.size() < 6) return refuse(counts_.impossible);
  std::array<std::int32_t, 4> edges = {n[0], n[1], n[0], n[1]};
  for (std::size_t i = 2; i < n.size(); ++i) {
    edges[i % 2] = std::min(edges[i % 2], n[i]);
    edges[2 + i % 2] = std::max(edges[2 + i % 2], n[i]);
  }
  return add(id, edges);
}

Event Decoder::add(std::string_view id, std::span<const std::int32_t, 4> edges) {
  const auto& [left, top, right, bottom] = std::array{edges[0], edges[1], edges[2], edges[3]};
  sensor::Blob blob;
  blob.x1 = static_cast<std::int16_t>(edge_pixels(left, kHalfWidth, kWidth));
  blob.y1 = static_cast<std::int16_t>(edge_pixels(top, kHalfHeight, kHeight));
  blob.x2 = static_cast<std::int16_t>(edge_pixels(right, kHalfWidth, kWidth) - 1);
  blob.y2 = static_cast<std::int16_t>(edge_pixels(bottom, kHalfHeight, kHeight) - 1);
  const bool outside = left >= kHalfWidth || right <= -kHalfWidth || top >= kHalfHeight || bottom <= -kHalfHeight;
  if (outside) return refuse(counts_.impossible);
  blob.x1 = std::min<std::int16_t>(blob.x1, kWidth - 1);
  blob.y1 = std::min<std::int16_t>(blob.y1, kHeight - 1);
  blob.x2 = std::max(blob.x1, blob.x2);
  blob.y2 = std::max(blob.y1, blob.y2);
  // The first pixel's middle is half a pixel from its edge.
  blob.cx = {
      std::clamp<std::int32_t>(edge_pixels((left + right) / 2, kHalfWidth, 10 * kWidth) - 5, 0, 10 * (kWidth - 1))};
  blob.cy = {
      std::clamp<std::int32_t>(edge_pixels((top + bottom) / 2, kHalfHeight, 10 * kHeight) - 5, 0, 10 * (kHeight - 1))};
  blob.signature = signature_of(id);
  if (building_ && !serial::insert_largest_first(next_, blob)) ++over_;
  return Event::kLine;
}

std::uint8_t Decoder::signature_of(std::string_view id) const {
  constexpr std::uint32_t kMax = 255;
  for (const Name& name : names_) {
    if (name.id == id) return name.signature;
  }
  std::size_t digits = 0;
  while (digits < id.size() && is_digit(id[id.size() - 1 - digits])) ++digits;
  id.remove_prefix(id.size() - digits);
  const std::optional<std::uint32_t> number = whole_number(id);
  return number && *number >= 1 && *number <= kMax ? static_cast<std::uint8_t>(*number) : std::uint8_t{1};
}

Event Decoder::refuse(std::uint32_t& counter) {
  ++counter;
  if (building_) ++counts_.incomplete;
  building_ = false;
  return Event::kNone;
}

}  // namespace fencepost::jevois
