#include "drivers/cmucam/decoder.hpp"

namespace fencepost::cmucam {
namespace {

constexpr std::uint8_t kRawStart = 0xFF;
constexpr char kPromptMark = ':';

// How many fields a packet of this letter has; 0: no such packet.
std::uint8_t fields_of(char letter) {
  switch (letter) {
    case 'M':
    case 'T': return 8;
    case 'N': return 9;
    case 'C':
    case 'S': return 6;
    default: return 0;
  }
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// A colon inside a line of a CMUcam4 ("ERR: Camera Timeout Error", "DAT: ") is no prompt.
bool takes_colon(std::string_view line) { return line == "ERR" || line == "DAT"; }

}  // namespace

Event Decoder::feed(std::uint8_t byte, base::Time now) {
  if (byte == kRawStart) {
    start_raw(now);
    return Event::kNone;
  }
  if (mode_ == Mode::kRawLetter || mode_ == Mode::kRawFields) return feed_raw(byte);
  return feed_text(byte, now);
}

void Decoder::start_raw(base::Time now) {
  if (mode_ != Mode::kText || (!fresh_ && size_ > 0)) ++broken_;
  mode_ = Mode::kRawLetter;
  fresh_ = true;
  started_ = now;
}

Event Decoder::feed_raw(std::uint8_t byte) {
  if (mode_ == Mode::kRawLetter) {
    wanted_ = fields_of(static_cast<char>(byte));
    packet_ = {started_, static_cast<char>(byte), 0, {}};
    mode_ = wanted_ == 0 ? Mode::kText : Mode::kRawFields;
    if (wanted_ == 0) ++broken_;
    return Event::kNone;
  }
  packet_.fields[packet_.count++] = byte;
  if (packet_.count < wanted_) return Event::kNone;
  mode_ = Mode::kText;
  return Event::kPacket;
}

Event Decoder::feed_text(std::uint8_t byte, base::Time now) {
  const char c = static_cast<char>(byte);
  if (fresh_) {
    fresh_ = false;
    size_ = 0;
    started_ = now;
  }
  if (c == kPromptMark && !(mode_ == Mode::kText && takes_colon(text()))) {
    mode_ = Mode::kText;
    fresh_ = true;
    return Event::kPrompt;
  }
  if (c == '\r') return end_line();
  if (mode_ == Mode::kSkipLine) return Event::kNone;
  if (size_ == kLine) {
    ++broken_;
    mode_ = Mode::kSkipLine;
    size_ = 0;
    return Event::kNone;
  }
  line_[size_++] = c;
  return Event::kNone;
}

Event Decoder::end_line() {
  fresh_ = true;
  if (mode_ == Mode::kSkipLine) {
    mode_ = Mode::kText;
    return Event::kNone;
  }
  if (size_ == 0) return Event::kNone;
  if (text() == "ACK") return Event::kAck;
  if (text() == "NCK") return Event::kNck;
  return parse_packet() ? Event::kPacket : Event::kText;
}

// "T 45 71 40": the letter, then spaces and numbers of a byte's range, as many as the letter has.
bool Decoder::parse_packet() {
  const std::string_view line = text();
  Packet packet{started_, line[0], 0, {}};
  const std::uint8_t wanted = fields_of(line[0]);
  if (wanted == 0) return false;
  std::size_t at = 1;
  while (at < line.size()) {
    if (line[at] != ' ' || packet.count == Packet::kMaxFields) return false;
    while (at < line.size() && line[at] == ' ') ++at;
    if (at == line.size()) break;
    int value = 0;
    std::size_t digits = 0;
    while (at < line.size() && is_digit(line[at]) && digits < 4) {
      value = 10 * value + (line[at++] - '0');
      ++digits;
    }
    if (digits == 0 || digits > 3 || value > 255) return false;
    packet.fields[packet.count++] = static_cast<std::uint8_t>(value);
  }
  const bool long_colours = packet.letter == 'S' && packet.count == Packet::kMaxFields;
  if (packet.count != wanted && !long_colours) return false;
  packet_ = packet;
  return true;
}

}  // namespace fencepost::cmucam
