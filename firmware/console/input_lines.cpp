#include "firmware/console/input_lines.hpp"

#include <algorithm>

#include "hal/base/check.hpp"

namespace fencepost::console {

std::span<std::uint8_t> InputLines::room() {
  if (begin_ > 0) {
    std::copy(bytes_.begin() + begin_, bytes_.begin() + end_, bytes_.begin());
    scanned_ = static_cast<std::uint16_t>(scanned_ - begin_);
    end_ = static_cast<std::uint16_t>(end_ - begin_);
    begin_ = 0;
  }
  const std::span<char> rest = std::span(bytes_).subspan(end_);
  return {static_cast<std::uint8_t*>(static_cast<void*>(rest.data())), rest.size()};
}

void InputLines::filled(std::size_t count) {
  FENCEPOST_CHECK(count <= bytes_.size() - end_);
  end_ = static_cast<std::uint16_t>(end_ + count);
}

std::optional<InputLines::Line> InputLines::front() {
  if (after_return_ && begin_ < end_) {
    after_return_ = false;
    if (bytes_[begin_] == '\n') scanned_ = ++begin_;
  }
  for (; scanned_ < end_; ++scanned_) {
    if (bytes_[scanned_] == '\r' || bytes_[scanned_] == '\n') {
      return Line{std::span(bytes_).subspan(begin_, scanned_ - begin_), too_long_};
    }
  }
  if (end_ - begin_ == kSize) too_long_ = true;
  if (too_long_) shorten();
  return std::nullopt;
}

void InputLines::pop_front() {
  FENCEPOST_CHECK(scanned_ < end_);
  after_return_ = bytes_[scanned_] == '\r';
  scanned_ = static_cast<std::uint16_t>(scanned_ + 1);
  begin_ = scanned_;
  too_long_ = false;
}

// Forgets all but the first characters of a line that is too long and goes on looking for its end.
void InputLines::shorten() {
  end_ = std::min(end_, static_cast<std::uint16_t>(begin_ + kKept));
  scanned_ = end_;
}

}  // namespace fencepost::console
