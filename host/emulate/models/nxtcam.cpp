#include "host/emulate/models/nxtcam.hpp"

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <utility>

namespace fencepost::emulate {
namespace {

constexpr std::uint8_t kAddress = 0x01;
constexpr std::size_t kCommandRegister = 0x41;
constexpr std::size_t kCount = 0x42;
constexpr std::size_t kMap = 0x80;
constexpr int kColumns = 176;
constexpr int kRows = 144;

// 88 columns, reported doubled.
std::uint8_t column(std::int16_t x) { return static_cast<std::uint8_t>(x / 2 * 2); }

/// The command's arguments; nullopt: one is larger than a byte, or more than 64 were sent.
std::optional<std::vector<std::uint8_t>> values_of(const std::string& line) {
  constexpr std::size_t kMax = 64;
  std::vector<std::uint8_t> values;
  std::istringstream words(line);
  std::string word;
  words >> word;
  while (words >> word) {
    const long value = std::strtol(word.c_str(), nullptr, 10);  // of "1A" the firmware takes the 1 as well
    if (value > 255 || values.size() == kMax) return std::nullopt;
    values.push_back(static_cast<std::uint8_t>(value));
  }
  return values;
}

int box_area(const sensor::Blob& blob) { return (blob.x2 - blob.x1 + 1) * (blob.y2 - blob.y1 + 1); }

}  // namespace

NxtCam::NxtCam(base::Time power_on) { restart(power_on); }

void NxtCam::restart(base::Time now) {
  registers_.fill(0);
  power_on_ = now;
  tracking_ = locked_ = sort_by_size_ = false;
  line_.clear();
}

void NxtCam::write_text(std::size_t at, const std::string& text) {
  std::fill_n(registers_.begin() + static_cast<std::ptrdiff_t>(at), 8, std::uint8_t{0});
  std::copy_n(text.begin(), std::min<std::size_t>(text.size(), 8),
              registers_.begin() + static_cast<std::ptrdiff_t>(at));
}

std::optional<std::vector<std::uint8_t>> NxtCam::transfer(std::uint8_t address, const std::vector<std::uint8_t>& out,
                                                          std::size_t expected, base::Time now) {
  if (address != kAddress || now - power_on_ < kBoot || out.empty()) return std::nullopt;
  write_text(0x00, "V4.10");
  write_text(0x08, "mndsnsrs");
  write_text(0x10, product_);
  for (std::size_t i = 1; i < out.size(); ++i) {
    const std::size_t at = (out[0] + i - 1) % registers_.size();
    registers_[at] = out[i];
    if (at == kCommandRegister) command(out[i], now);
  }
  std::vector<std::uint8_t> in;
  for (std::size_t i = 0; i < expected; ++i) in.push_back(registers_[(out[0] + i) % registers_.size()]);
  return in;
}

void NxtCam::command(std::uint8_t letter, base::Time now) {
  switch (letter) {
    case 'A': sort_by_size_ = true; break;
    case 'X': sort_by_size_ = false; break;
    case 'E': tracking_ = true; break;
    case 'D': tracking_ = false, registers_[kCount] = 0; break;
    case 'G': fill_map(); break;
    case 'J': locked_ = true; break;
    case 'K': locked_ = false; break;
    case 'R': restart(now); break;
    default: break;
  }
}

// A colour is the reds of one entry, the greens of the next, the blues of the one after.
void NxtCam::fill_map() {
  if (map_) {
    std::copy(map_->begin(), map_->end(), registers_.begin() + kMap);
    return;
  }
  std::fill_n(registers_.begin() + kMap, 48, std::uint8_t{0});
  for (unsigned colour = 0; colour < 8; ++colour) {
    if ((static_cast<unsigned>(taught_) >> colour & 1U) == 0) continue;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      std::uint8_t& entry = registers_[kMap + 16 * channel + colour + channel];
      entry = static_cast<std::uint8_t>(static_cast<unsigned>(entry) | 1U << colour);
    }
  }
}

void NxtCam::show(const std::vector<sensor::Blob>& blobs) {
  seen_ = blobs;
  if (!tracking_ || locked_) return;
  std::vector<sensor::Blob> list = blobs;
  const auto larger = [](const sensor::Blob& a, const sensor::Blob& b) { return box_area(a) > box_area(b); };
  if (sort_by_size_) std::stable_sort(list.begin(), list.end(), larger);
  list.resize(std::min<std::size_t>(list.size(), 8));
  registers_[kCount] = static_cast<std::uint8_t>(list.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::size_t at = kCount + 1 + 5 * i;
    registers_[at] = list[i].signature;
    registers_[at + 1] = column(list[i].x1);
    registers_[at + 2] = static_cast<std::uint8_t>(list[i].y1);
    registers_[at + 3] = column(list[i].x2);
    registers_[at + 4] = static_cast<std::uint8_t>(list[i].y2);
  }
}

std::vector<std::uint8_t> NxtCam::packet() const {
  if (!tracking_) return {};
  const auto count = static_cast<std::ptrdiff_t>(registers_[kCount]);
  std::vector<std::uint8_t> bytes = {0x0A, registers_[kCount]};
  bytes.insert(bytes.end(), registers_.begin() + kCount + 1, registers_.begin() + kCount + 1 + 5 * count);
  bytes.push_back(0xFF);
  return bytes;
}

std::vector<std::uint8_t> NxtCam::take(std::uint8_t byte, base::Time now) {
  if (now - power_on_ < kBoot) return {};
  if (byte != '\r') {
    const bool stored = byte == ' ' || (byte >= '0' && byte <= '9') || (byte >= 'A' && byte <= 'Z');
    if (stored && line_.size() < 256) line_.push_back(static_cast<char>(byte));
    return {};
  }
  const std::string answer = obey(std::exchange(line_, {}));
  return {answer.begin(), answer.end()};
}

std::string NxtCam::obey(const std::string& line) {
  const std::string name = line.substr(0, line.find(' '));
  const auto values = values_of(line);
  if (!values) return "NCK\r";
  if (name == "PG") return "ACK\r";
  if (name == "GV") return "ACK\rAVRcam v1.4\r";
  if (name == "ET" || name == "DT") {
    tracking_ = name == "ET";
    return "ACK\r";
  }
  if (name == "DF") return "ACK\r" + (tracking_ ? std::string() : picture());
  if (name == "SM") {
    std::array<std::uint8_t, 48> map{};
    std::copy_n(values->begin(), std::min(values->size(), map.size()), map.begin());
    map_ = map;
    return "ACK\r";
  }
  not_emulated_.note(name.empty() || name.size() > 8 ? "unreadable bytes" : name);
  // Registers and reset of the image sensor, objects or lines.
  const bool accepted = name == "CR" || name == "RS" || name == "TO" || name == "TL";
  return accepted ? "ACK\r" : "NCK\r";
}

// Each packet has two lines. A byte holds one pixel of each, of which the Bayer pattern keeps four bits. Things are
// light, all else is dark. No byte is the packet's end, by which some hosts find it.
std::string NxtCam::picture() const {
  constexpr char kDark = 0x4;
  constexpr char kLight = 0xC;
  const auto level = [this](int x, int y) {
    const auto holds = [&](const sensor::Blob& blob) {
      return x >= blob.x1 && x <= blob.x2 && y >= blob.y1 && y <= blob.y2;
    };
    return std::any_of(seen_.begin(), seen_.end(), holds) ? kLight : kDark;
  };
  std::string packets;
  for (int y = 0; y < kRows; y += 2) {
    packets += {'\x0B', static_cast<char>(y / 2)};
    for (int x = 0; x < kColumns; ++x) packets += static_cast<char>(16 * level(x, y) + level(x, y + 1));
    packets += '\x0F';
  }
  return packets;
}

}  // namespace fencepost::emulate
