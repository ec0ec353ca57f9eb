#include "host/emulate/models/create.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

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

// Of packet 35.
constexpr int kOff = 0;
constexpr int kPassive = 1;
constexpr int kSafeMode = 2;
constexpr int kFullMode = 3;

// Bytes that the line takes in 15 ms, at 57600 and at 115200 Bd.
constexpr std::size_t kFitsInOne = 86;
constexpr std::size_t kFitsInTwo = 172;

constexpr int kFastest = 500;         // mm/s
constexpr int kWidestRadius = 2'000;  // mm
// Between the wheels, mm.
constexpr double kTrackOfOne = 258;
constexpr double kTrackOfTwo = 235;
constexpr double kMillimetresPerCount = std::numbers::pi * 72.0 / 508.8;

int at(std::string_view bytes, std::size_t i) { return static_cast<unsigned char>(bytes[i]); }

int signed_at(std::string_view bytes, std::size_t i) {
  return static_cast<std::int16_t>(256 * at(bytes, i) + at(bytes, i + 1));
}

// The Open Interface's special radii: straight, and on the spot to the right and to the left.
CreateDevice::Speeds speeds_of(int velocity, int radius, double track) {
  velocity = std::clamp(velocity, -kFastest, kFastest);
  if (radius == 0x7FFF || radius == -0x8000) return {velocity, velocity};
  if (radius == -1) return {velocity, -velocity};
  if (radius == 1) return {-velocity, velocity};
  radius = std::clamp(radius, -kWidestRadius, kWidestRadius);
  if (radius == 0) return {velocity, velocity};
  const double share = track / 2 / radius;
  return {static_cast<int>(std::lround(velocity * (1 - share))), static_cast<int>(std::lround(velocity * (1 + share)))};
}

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
  set_mode(kOff);
  unsent_ = 0;
  driven_ = false;
  speeds_ = {};
  streaming_ = false;
  left_ = right_ = 0;
  left_rest_ = right_rest_ = 0;
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

void CreateDevice::drive_on(double seconds) {
  if (!driven_) return;
  const auto turn = [seconds](int speed, double& rest) {
    rest += speed * seconds / kMillimetresPerCount;
    const double counts = std::trunc(rest);
    rest -= counts;
    return static_cast<int>(counts);
  };
  const int left = turn(speeds_.left, left_rest_);
  roll(left, turn(speeds_.right, right_rest_));
  const double mm = (speeds_.left + speeds_.right) / 2.0 * seconds;
  move(mm, (speeds_.right - speeds_.left) * seconds / track() * 180 / std::numbers::pi);
}

double CreateDevice::track() const { return model_ == CreateModel::kOne ? kTrackOfOne : kTrackOfTwo; }

void CreateDevice::lift() {
  if (mode_ == kSafeMode) set_mode(kPassive);
}

// Only in safe and full does it go as it was told.
void CreateDevice::set_mode(int mode) {
  mode_ = mode;
  if (mode < kSafeMode && driven_) speeds_ = {};
}

void CreateDevice::obey_drive() {
  if (mode_ < kSafeMode) return;
  driven_ = true;
  if (at(pending_, 0) == kDrive) {
    speeds_ = speeds_of(signed_at(pending_, 1), signed_at(pending_, 3), track());
  } else {
    speeds_ = {std::clamp(signed_at(pending_, 3), -kFastest, kFastest),
               std::clamp(signed_at(pending_, 1), -kFastest, kFastest)};
  }
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
  if (opcode == kStart) set_mode(kPassive);
  if (mode_ == kOff) return {};
  if (opcode == kSafe) set_mode(kSafeMode);
  if (opcode == kFull) set_mode(kFullMode);
  if (opcode == kDrive || opcode == kDriveDirect) obey_drive();
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
    case 41: return big_endian(static_cast<std::uint16_t>(speeds_.right));
    case 42: return big_endian(static_cast<std::uint16_t>(speeds_.left));
    case 43: return model_ == CreateModel::kTwo ? big_endian(left_) : std::string();
    case 44: return model_ == CreateModel::kTwo ? big_endian(right_) : std::string();
    default: return {};
  }
}

std::string CreateDevice::frame() {
  if (!streaming_) return {};
  // Of a longer list than fits, frames come as the line takes them.
  const std::size_t fits = model_ == CreateModel::kOne ? kFitsInOne : kFitsInTwo;
  unsent_ -= std::min(unsent_, fits);
  if (unsent_ > 0) return {};
  std::string payload;
  for (const int id : stream_) {
    const std::string value = value_of(id);
    if (!value.empty()) payload += static_cast<char>(id) + value;
  }
  std::string bytes = "\x13" + std::string(1, static_cast<char>(payload.size())) + payload;
  unsigned sum = 0;
  for (std::size_t i = header_in_checksum_ ? 0 : 1; i < bytes.size(); ++i) sum += static_cast<unsigned char>(bytes[i]);
  bytes += static_cast<char>(256 - sum % 256);
  unsent_ = bytes.size();
  return bytes;
}

}  // namespace fencepost::emulate
