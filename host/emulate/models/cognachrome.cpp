#include "host/emulate/models/cognachrome.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "host/emulate/models/messages.hpp"
#include "host/text/plural.hpp"

namespace fencepost::emulate {
namespace {

constexpr int kBase = 254;

int pixels_of(const sensor::Blob& blob) {
  if (blob.pixels != 0) return static_cast<int>(blob.pixels);
  return (blob.x2 - blob.x1 + 1) * (blob.y2 - blob.y1 + 1);
}
int column_of(const sensor::Blob& blob) { return (blob.x1 + blob.x2 + 1) / 2; }
int row_of(const sensor::Blob& blob) { return (blob.y1 + blob.y2 + 1) / 2; }

void put_word(Bytes& bytes, int value) {
  bytes.push_back(static_cast<std::uint8_t>(value / kBase));
  bytes.push_back(static_cast<std::uint8_t>(value % kBase));
}

/// Renders the protocol string for the blob; the header has none.
void render(Bytes& bytes, const std::string& text, const sensor::Blob& blob) {
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] == '\\' && at + 3 < text.size()) {
      // Digits damaged on their way are some character, too.
      int value = 0;
      for (int digit = 0; digit < 3; ++digit) value = 8 * value + (text[++at] & 7);
      bytes.push_back(static_cast<std::uint8_t>(value & 0xFF));
    } else if (text[at] == '%' && at + 2 < text.size() && text[at + 1] == 'w') {
      const char what = text[at + 2];
      put_word(bytes, what == 'C' ? column_of(blob) : what == 'R' ? row_of(blob) : pixels_of(blob));
      at += 2;
    } else {
      bytes.push_back(static_cast<std::uint8_t>(text[at]));
    }
  }
}

}  // namespace

Bytes Cognachrome::power_up(base::Time now) {
  power_on_ = now;
  next_field_ = free_ = now + kStart;
  tracking_ = preset_ == Preset::kTeamBots;
  asks_ = Asks::kKey;
  strings_ = {};
  line_.clear();
  break_ = false;
  stream_ = 0;
  channel_ = 'a';
  return {};
}

std::string Cognachrome::prompt() const { return std::string("\r\ntpuvis [") + channel_ + "]> "; }

Bytes Cognachrome::take(std::uint8_t byte, base::Time now) {
  if (now - power_on_ < kStart || preset_ == Preset::kTeamBots) return {};
  if (std::exchange(break_, false)) {
    stream_ = byte;
    return {};
  }
  if (byte == 0xFE) {
    break_ = true;
    return {};
  }
  if (stream_ != 3) return {};
  const std::string said = answer(static_cast<char>(byte));
  if (said.empty()) return {};
  Bytes bytes = {0xFE, 3};
  for (const char c : said) bytes.push_back(static_cast<std::uint8_t>(c));
  return bytes;
}

std::string Cognachrome::answer(char key) {
  switch (asks_) {
    case Asks::kKey: return answer_key(key);
    case Asks::kWhich: return answer_which(key);
    case Asks::kChannel:
      asks_ = Asks::kKey;
      if (key >= 'a' && key <= 'c') channel_ = key;
      return prompt();
    case Asks::kFilter:
    case Asks::kObjects:
    case Asks::kString: break;
  }
  if (key != '\n') {
    line_ += key;
    return {};
  }
  const std::string line = std::exchange(line_, {});
  if (std::exchange(asks_, Asks::kKey) == Asks::kString) strings_.at(which_) = line;
  return prompt();
}

std::string Cognachrome::answer_key(char key) {
  switch (key) {
    case 'r': tracking_ = true; return {};
    case 'q': tracking_ = false; return prompt();
    case 'a': asks_ = Asks::kChannel; return {};
    case 'f': asks_ = Asks::kFilter; return {};
    case 'p': asks_ = Asks::kWhich; return {};
    case 'n': asks_ = Asks::kObjects; return "\r\n# of objects for channel [8] ";
    case 's': return "\r\nAdding to training" + prompt();
    case 'j': return "\r\nRetraining" + prompt();
    case 'S': return "\r\nSaving ..." + prompt();
    case '\n': return prompt();
    default: return {};
  }
}

std::string Cognachrome::answer_which(char key) {
  constexpr std::string_view kWhich = "habc";
  which_ = kWhich.find(key);
  asks_ = which_ == std::string_view::npos ? Asks::kKey : Asks::kString;
  if (asks_ == Asks::kKey) return prompt();
  if (which_ == 0) return "\r\nNew protocol header:";
  return std::string("\r\nNew protocol chan ") + static_cast<char>(key - 'a' + 'A') + ":";
}

Bytes Cognachrome::see(const sensor::BlobFrame& frame, base::Time /*now*/) {
  show({frame.blobs.begin(), frame.blobs.end()});
  return {};
}

// A field that finds the line busy is not sent.
Bytes Cognachrome::step(base::Time now) {
  constexpr std::int64_t kTicksASecond = base::milliseconds(1'000).raw;
  next_field_ = next_field_ + kField;
  if (!tracking_ || now < free_) return {};
  Bytes bytes;
  if (preset_ == Preset::kTeamBots) {
    const std::string text = hex_field();
    bytes.assign(text.begin(), text.end());
  } else {
    bytes = field();
  }
  // Rounded up: a line that gets more than it can carry falls behind without end.
  const std::int64_t bits = 10 * static_cast<std::int64_t>(bytes.size());
  if (baud_ != 0) free_ = now + base::Duration{(kTicksASecond * bits + baud_ - 1) / baud_};
  return bytes;
}

Bytes Cognachrome::field() {
  Bytes bytes;
  render(bytes, strings_[0], {});
  for (std::size_t channel = 1; channel < strings_.size(); ++channel) {
    for (const sensor::Blob& blob : blobs_) {
      if (blob.signature == channel) render(bytes, strings_[channel], blob);
    }
  }
  return bytes;
}

std::string Cognachrome::hex_field() {
  constexpr std::string_view kMarks = "#&^";
  constexpr std::size_t kMax = 4;
  char text[24] = {};
  (void)std::snprintf(text, sizeof text, "$%02X", count_++ & 0xFFU);
  std::string said = text;
  for (std::size_t i = 0; i < std::min(blobs_.size(), kMax); ++i) {
    const sensor::Blob& blob = blobs_[i];
    const auto root = static_cast<unsigned>(std::lround(std::sqrt(pixels_of(blob))));
    (void)std::snprintf(text, sizeof text, "%c%02X:%02X:%02X:00", kMarks[blob.signature - 1U], std::min(root, 255U),
                        static_cast<unsigned>(column_of(blob)), static_cast<unsigned>(row_of(blob)));
    said += text;
  }
  return said;
}

std::string describe_cognachrome(bool from_host, std::span<const std::uint8_t> bytes) {
  if (!from_host && bytes[0] == 0xFF) return host::plural(bytes.size() / 7, "object");
  return describe_text(from_host, bytes);
}

}  // namespace fencepost::emulate
