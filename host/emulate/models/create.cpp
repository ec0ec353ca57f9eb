#include "host/emulate/models/create.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fencepost::emulate {
namespace {

constexpr int kReset = 7;
constexpr int kStart = 128;
constexpr int kSafe = 131;
constexpr int kFull = 132;
constexpr int kControl = 130;
constexpr int kPower = 133;
constexpr int kSpot = 134;
constexpr int kClean = 135;
constexpr int kDemo = 136;
constexpr int kDrive = 137;
constexpr int kSensors = 142;
constexpr int kDock = 143;
constexpr int kDriveDirect = 145;
constexpr int kDrivePwm = 146;
constexpr int kStream = 148;
constexpr int kQueryList = 149;
constexpr int kPauseResume = 150;
constexpr int kStop = 173;

constexpr int kOff = 0;  // modes, as packet 35 reports them
constexpr int kPassive = 1;
constexpr int kSafeMode = 2;
constexpr int kFullMode = 3;

constexpr std::size_t kFitsInOne = 86;   // bytes that the line takes in 15 ms at 57600 Bd (Create 1)
constexpr std::size_t kFitsInTwo = 172;  // at 115200 Bd (Create 2)

constexpr int kFastest = 500;         // mm/s
constexpr int kWidestRadius = 2'000;  // mm
constexpr int kStraight = 0x7FFF;
constexpr int kFullPwm = 255;
constexpr double kTrackOfOne = 258;  // mm between the wheels of a Create 1
constexpr double kTrackOfTwo = 235;  // mm, of a Create 2
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

int radius_of(const CreateDevice::Speeds& speeds, double track) {
  if (speeds.left == speeds.right) return speeds.left == 0 ? 0 : kStraight;
  if (speeds.left == -speeds.right) return speeds.right > 0 ? 1 : -1;
  const double radius = track / 2 * (speeds.left + speeds.right) / (speeds.right - speeds.left);
  return std::clamp(static_cast<int>(std::lround(radius)), -kWidestRadius, kWidestRadius);
}

// Reading clears the amount and loses its fraction, as a Create 1 is known to do.
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

// It obeys drive commands only in safe and full mode.
void CreateDevice::set_mode(int mode) {
  mode_ = mode;
  if (mode < kSafeMode && driven_) speeds_ = {};
}

void CreateDevice::obey_drive() {
  if (mode_ < kSafeMode) return;
  driven_ = true;
  if (at(pending_, 0) == kDrivePwm) {
    const auto speed = [this](std::size_t i) {
      return std::clamp(signed_at(pending_, i), -kFullPwm, kFullPwm) * kFastest / kFullPwm;
    };
    speeds_ = {speed(3), speed(1)};
  } else if (at(pending_, 0) == kDrive) {
    speeds_ = speeds_of(signed_at(pending_, 1), signed_at(pending_, 3), track());
  } else {
    speeds_ = {std::clamp(signed_at(pending_, 3), -kFastest, kFastest),
               std::clamp(signed_at(pending_, 1), -kFastest, kFastest)};
  }
}

std::string CreateDevice::feed(std::string_view bytes) {
  std::string replies;
  for (const char byte : bytes) {
    const bool opcode = pending_.empty() && static_cast<unsigned char>(byte) < kStart;
    if (opcode && (byte != kReset || model_ == CreateModel::kOne)) {
      not_emulated_.note("bytes below 128 that are no opcode");
      continue;
    }
    pending_ += byte;
    if (pending_.size() < 1 + create_arguments(model_, pending_).value_or(0)) continue;
    replies += obey();
    pending_.clear();
  }
  return replies;
}

std::string CreateDevice::obey() {
  const int opcode = at(pending_, 0);
  if (opcode == kReset) {
    static_cast<void>(power_up());
    not_emulated_.note("boot message");
  }
  if (opcode == kStart) set_mode(kPassive);
  if (mode_ == kOff) return {};
  act(opcode);
  if (opcode == kSensors) return value_of(at(pending_, 1));
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

void CreateDevice::act(int opcode) {
  switch (opcode) {
    case kStart:
    case kSensors:
    case kStream:
    case kQueryList: break;
    case kControl:
    case kSafe: set_mode(kSafeMode); break;
    case kFull: set_mode(kFullMode); break;
    // It would drive by itself, which is not emulated, or go to sleep: passive in each case.
    case kPower:
    case kSpot:
    case kClean:
    case kDemo:
    case kDock: set_mode(kPassive); break;
    case kDrive:
    case kDriveDirect: obey_drive(); break;
    case kDrivePwm: model_ == CreateModel::kTwo ? obey_drive() : not_emulated_.note("opcode 146"); break;
    case kPauseResume: streaming_ = at(pending_, 1) == 1; break;
    case kStop:
      if (model_ == CreateModel::kOne) break;
      streaming_ = false;
      set_mode(kOff);
      break;
    // Lights, songs and brushes: they change nothing that a packet reports.
    default:
      if (!create_arguments(model_, pending_)) not_emulated_.note("opcode " + std::to_string(opcode));
  }
}

std::string CreateDevice::value_of(int id) {
  const std::vector<int> group = create_group(model_, id);
  if (group.empty()) return packet(id);
  std::string bytes;
  for (const int member : group) bytes += packet(member);
  return bytes;
}

std::string CreateDevice::packet(int id) {
  const std::size_t size = create_packet_size(model_, id);
  if (size == 0) {
    not_emulated_.note("packet " + std::to_string(id));
    return {};
  }
  const auto value = static_cast<std::uint16_t>(word(id));
  return size == 2 ? big_endian(value) : std::string(1, static_cast<char>(value & 0xFF));
}

// On a floor without walls or edges, its battery nearly full, nobody touching it.
int CreateDevice::word(int id) {
  switch (id) {
    case 19: return whole(mm_);
    case 20: return whole(degrees_);
    case 22: return 16'000;  // mV
    case 23: return -300;    // mA
    case 24: return 25;      // degrees Celsius
    case 25: return 2'600;   // mAh
    case 26: return 2'696;
    case 28:
    case 29:
    case 30:
    case 31: return 0x0219;  // cliff sensors: signal reflected from the floor
    case 35: return mode_;
    case 38: return static_cast<int>(stream_.size());
    case 39: return (speeds_.left + speeds_.right) / 2;
    case 40: return radius_of(speeds_, track());
    case 41: return speeds_.right;
    case 42: return speeds_.left;
    case 43: return left_;
    case 44: return right_;
    default: return 0;
  }
}

std::string CreateDevice::frame() {
  if (!streaming_) return {};
  // Frames of a list longer than fits come as the line takes them.
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
