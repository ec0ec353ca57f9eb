#include "tests/boards/gba/link_port.hpp"

#include <algorithm>
#include <array>

namespace fencepost::test {
namespace {

constexpr std::uint64_t kHz = 16'777'216;
constexpr std::uint16_t kFull = 1U << 4;
constexpr std::uint16_t kEmpty = 1U << 5;
constexpr std::uint16_t kFault = 1U << 6;
constexpr std::uint16_t kEightBits = 1U << 7;
constexpr std::uint16_t kFifoOn = 1U << 8;
constexpr std::uint16_t kSend = 1U << 10;
constexpr std::uint16_t kReceive = 1U << 11;

}  // namespace

std::uint64_t LinkPort::byte_cycles() const {
  constexpr std::array<std::uint64_t, 4> kBauds = {9'600, 38'400, 57'600, 115'200};
  return 10 * kHz / kBauds[control_ & 3U];
}

void LinkPort::receive_one() {
  const std::uint8_t byte = cable_.front();
  cable_.pop_front();
  if (!enabled(kReceive)) return;
  if (received_.size() < kFifo) {
    received_.push_back(byte);
  } else {
    fault_ = true;
    ++overruns_;
  }
}

void LinkPort::advance(std::uint64_t now) {
  for (; !cable_.empty() && next_received_ <= now; next_received_ += byte_cycles()) receive_one();
  for (; !sending_.empty() && next_sent_ <= now; next_sent_ += byte_cycles()) {
    sent_ += static_cast<char>(sending_.front());
    sending_.pop_front();
  }
  if (cable_.empty()) next_received_ = std::max(next_received_, now + byte_cycles());
  if (sending_.empty()) next_sent_ = std::max(next_sent_, now + byte_cycles());
}

std::uint16_t LinkPort::read(std::uint32_t address, std::uint64_t now) {
  advance(now);
  if (address == kData) {
    if (received_.empty()) return 0;
    const std::uint8_t byte = received_.front();
    received_.pop_front();
    return byte;
  }
  const bool was_fault = fault_;
  fault_ = false;
  return static_cast<std::uint16_t>((control_ & ~(kFull | kEmpty | kFault)) | (sending_.size() == kFifo ? kFull : 0) |
                                    (received_.empty() ? kEmpty : 0) | (was_fault ? kFault : 0));
}

void LinkPort::write(std::uint32_t address, std::uint16_t value, std::uint64_t now) {
  advance(now);
  if (address == kControl) {
    control_ = value;
    if (!enabled(kFifoOn)) received_.clear(), sending_.clear();
  } else if (enabled(kSend) && enabled(kEightBits) && sending_.size() < kFifo) {
    sending_.push_back(static_cast<std::uint8_t>(value));
  }
}

std::size_t LinkPort::put(std::string_view bytes) {
  cable_.insert(cable_.end(), bytes.begin(), bytes.end());
  return bytes.size();
}

std::string LinkPort::get(std::size_t most) {
  std::string bytes = sent_.substr(0, most);
  sent_.erase(0, bytes.size());
  return bytes;
}

}  // namespace fencepost::test
