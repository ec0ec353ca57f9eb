#include "host/emulate/models/create.hpp"

#include <cmath>

namespace fencepost::emulate {
namespace {

constexpr int kStart = 128;
constexpr int kSafe = 131;
constexpr int kFull = 132;
constexpr int kDrive = 137;
constexpr int kSensors = 142;
constexpr int kDriveDirect = 145;
constexpr int kStream = 148;
constexpr int kQueryList = 149;
constexpr int kPauseResume = 150;

int at(std::string_view bytes, std::size_t i) { return static_cast<unsigned char>(bytes[i]); }

std::string big_endian(std::uint16_t value) { return {static_cast<char>(value >> 8), static_cast<char>(value & 0xFF)}; }

// What is read is gone, what was cut off too: that is the Create 1's known loss.
std::uint16_t whole(double& amount) {
  const double told = std::trunc(amount);
  amount = 0;
  return static_cast<std::uint16_t>(static_cast<int>(told));
}

}  // namespace

std::string CreateDevice::power_up() {
  pending_.clear();
  stream_.clear();
  mode_ = 0;
  streaming_ = false;
  left_ = right_ = 0;
  mm_ = degrees_ = 0;
  return {};
}

void CreateDevice::roll(int left, int right) {
  left_ = static_cast<std::uint16_t>(left_ + left);
  right_ = static_cast<std::uint16_t>(right_ + right);
}

void CreateDevice::move(double mm, double degrees) {
  mm_ += mm;
  degrees_ += degrees;
}

std::string CreateDevice::feed(std::string_view bytes) {
  std::string replies;
  for (const char byte : bytes) {
    if (pending_.empty() && static_cast<unsigned char>(byte) < kStart) continue;
    pending_ += byte;
    if (pending_.size() < 1 + arguments_wanted()) continue;
    replies += obey();
    pending_.clear();
  }
  return replies;
}

std::size_t CreateDevice::arguments_wanted() const {
  switch (at(pending_, 0)) {
    case kDrive:
    case kDriveDirect: return 4;
    case kSensors:
    case kPauseResume: return 1;
    case kStream:
    case kQueryList: return pending_.size() < 2 ? 1 : 1U + static_cast<std::size_t>(at(pending_, 1));
    default: return 0;
  }
}

std::string CreateDevice::obey() {
  const int opcode = at(pending_, 0);
  if (opcode == kStart) mode_ = 1;
  if (mode_ == 0) return {};
  if (opcode == kSafe) mode_ = 2;
  if (opcode == kFull) mode_ = 3;
  if (opcode == kSensors) return value_of(at(pending_, 1));
  if (opcode == kPauseResume) streaming_ = at(pending_, 1) == 1;
  if (opcode != kStream && opcode != kQueryList) return {};
  std::vector<int> ids;
  for (std::size_t i = 2; i < pending_.size(); ++i) ids.push_back(at(pending_, i));
  if (opcode == kStream) {
    stream_ = ids;
    streaming_ = true;
    return {};
  }
  std::string values;
  for (const int id : ids) values += value_of(id);
  return values;
}

std::string CreateDevice::value_of(int id) {
  switch (id) {
    case 13: return std::string(1, '\0');  // virtual wall: none
    case 29: return big_endian(0x0219);    // cliff signal
    case 35: return std::string(1, static_cast<char>(mode_));
    case 19: return big_endian(whole(mm_));
    case 20: return big_endian(whole(degrees_));
    case 43: return model_ == CreateModel::kTwo ? big_endian(left_) : std::string();
    case 44: return model_ == CreateModel::kTwo ? big_endian(right_) : std::string();
    default: return {};
  }
}

std::string CreateDevice::frame() {
  if (!streaming_) return {};
  std::string payload;
  for (const int id : stream_) {
    const std::string value = value_of(id);
    if (!value.empty()) payload += static_cast<char>(id) + value;
  }
  std::string bytes = "\x13" + std::string(1, static_cast<char>(payload.size())) + payload;
  unsigned sum = 0;
  for (std::size_t i = header_in_checksum_ ? 0 : 1; i < bytes.size(); ++i) sum += static_cast<unsigned char>(bytes[i]);
  return bytes + static_cast<char>(256 - sum % 256);
}

}  // namespace fencepost::emulate
