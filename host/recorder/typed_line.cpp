#include "host/recorder/typed_line.hpp"

#include <utility>

namespace fencepost::host {
namespace {

constexpr char kEscape = 0x1b;
constexpr char kDelete = 0x7f;
constexpr char kCtrlU = 0x15;

bool continues_a_character(char byte) { return (static_cast<unsigned char>(byte) & 0xC0) == 0x80; }
bool is_control(char byte) { return static_cast<unsigned char>(byte) < ' '; }

}  // namespace

// ESC [ or ESC O, parameters, and one character from '@' on (ECMA-48, 5.4).
bool TypedLine::in_escape(char byte) {
  switch (escape_) {
    case Escape::kNone:
      if (byte == kEscape) escape_ = Escape::kBegun;
      return byte == kEscape;
    case Escape::kBegun: escape_ = byte == '[' || byte == 'O' ? Escape::kWithin : Escape::kNone; return true;
    case Escape::kWithin:
      if (byte >= '@' && byte <= '~') escape_ = Escape::kNone;
      return true;
  }
  return false;
}

void TypedLine::erase_last() {
  while (!text_.empty() && continues_a_character(text_.back())) text_.pop_back();
  if (!text_.empty()) text_.pop_back();
}

std::optional<std::string> TypedLine::push(char byte) {
  if (in_escape(byte)) return std::nullopt;
  if (byte == '\r' || byte == '\n') return std::exchange(text_, {});
  if (byte == kDelete || byte == '\b') {
    erase_last();
  } else if (byte == kCtrlU) {
    text_.clear();
  } else if (!is_control(byte) && text_.size() < kLongest) {
    text_ += byte;
  }
  return std::nullopt;
}

}  // namespace fencepost::host
