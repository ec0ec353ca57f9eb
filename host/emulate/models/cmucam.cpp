#include "host/emulate/models/cmucam.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>
#include <utility>

#include "host/emulate/models/cmucam_commands.hpp"

namespace fencepost::emulate {
namespace {

constexpr std::array kWholeWindow = {0, 0, 159, 119};  // of a CMUcam4
constexpr std::size_t kNoCount = 99;                   // of arguments that are no numbers
constexpr int kLowestBaud = 1'200;
constexpr int kHighestBaud = 250'000;
constexpr int kRawOutput = 1;
constexpr int kNoAck = 2;
constexpr int kRawInput = 4;

/// The one box that the camera sees within its bounds.
struct Seen {
  int pixels = 0;
  int sum_x = 0;
  int sum_y = 0;
  int x1 = 0;
  int y1 = 0;
  int x2 = 0;
  int y2 = 0;
};

void add(Seen& seen, const ColouredSpot& spot) {
  const bool first = seen.pixels == 0;
  seen.x1 = first ? spot.x1 : std::min(seen.x1, spot.x1);
  seen.y1 = first ? spot.y1 : std::min(seen.y1, spot.y1);
  seen.x2 = first ? spot.x2 : std::max(seen.x2, spot.x2);
  seen.y2 = first ? spot.y2 : std::max(seen.y2, spot.y2);
  seen.pixels += spot.pixels;
  seen.sum_x += spot.pixels * (spot.x1 + spot.x2) / 2;
  seen.sum_y += spot.pixels * (spot.y1 + spot.y2) / 2;
}

int confidence(CmuCamModel model, const Seen& seen) {
  const int width = seen.x2 - seen.x1;
  const int height = seen.y2 - seen.y1;
  switch (model) {
    case CmuCamModel::kOne: return seen.pixels * 256 / ((width + 1) * (height + 1));
    case CmuCamModel::kTwo:
    case CmuCamModel::kThree: return width * height == 0 ? 255 : 1000 * seen.pixels / (width * height);
    case CmuCamModel::kFour: return seen.pixels * 255 / ((width + 1) * (height + 1));
  }
  return 0;
}

int told_pixels(CmuCamModel model, int pixels) {
  switch (model) {
    case CmuCamModel::kOne: return (pixels + 4) / 8;
    case CmuCamModel::kTwo:
    case CmuCamModel::kThree: return pixels;
    case CmuCamModel::kFour: return pixels * 255 / (160 * 120);
  }
  return 0;
}

std::vector<int> fields_of(CmuCamModel model, const Seen& seen, bool middle) {
  std::vector<int> fields(middle ? 8 : 6, 0);
  if (seen.pixels == 0) return fields;
  const int first = model == CmuCamModel::kOne || model == CmuCamModel::kTwo ? 1 : 0;
  fields = {seen.sum_x / seen.pixels + first,
            seen.sum_y / seen.pixels + first,
            seen.x1 + first,
            seen.y1 + first,
            seen.x2 + first,
            seen.y2 + first,
            told_pixels(model, seen.pixels),
            confidence(model, seen)};
  if (!middle) fields.erase(fields.begin(), fields.begin() + 2);
  for (int& field : fields) field = std::min(field, 255);
  return fields;
}

/// The name for people; bytes that are no text are described.
std::string told_name(const std::string& name) {
  const auto plain = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
  return !name.empty() && name.size() <= 8 && std::all_of(name.begin(), name.end(), plain) ? name : "unreadable bytes";
}

}  // namespace

std::string CmuCamDevice::banner() const {
  switch (model_) {
    case CmuCamModel::kOne: return "CMUcam v1.12\r";
    case CmuCamModel::kTwo: return "CMUcam2 v1.00 c6\r";
    case CmuCamModel::kThree: return "CMUcam2 v1.00 c6";
    case CmuCamModel::kFour: return "CMUcam4 v1.02\r";
  }
  return {};
}

void CmuCamDevice::reset() {
  line_.clear();
  raw_.clear();
  std::fill(std::begin(bounds_), std::end(bounds_), 0);
  std::copy_n(kWholeWindow.begin(), 4, window_);
  mode_ = 0;
  baud_ = 0;
  polled_ = tracking_ = false;
  reports_middle_ = true;
}

// A CMUcam3 ends the text at power-up with a CR, that of GV without; a CMUcam4 begins it with one.
std::string CmuCamDevice::greeting() const {
  if (model_ == CmuCamModel::kFour) return "\r" + banner() + ":";
  return (model_ == CmuCamModel::kThree ? banner() + "\r" : banner()) + ":";
}

std::string CmuCamDevice::power_up() {
  reset();
  starting_ = model_ == CmuCamModel::kThree || model_ == CmuCamModel::kFour;
  return starting_ ? "" : greeting();
}

std::string CmuCamDevice::finish_start() {
  starting_ = false;
  return greeting();
}

std::string CmuCamDevice::answer(bool good, std::string_view data) const {
  std::string bytes;
  if ((mode_ & kNoAck) == 0) bytes = good ? "ACK\r" : "NCK\r";
  return bytes.append(data) + ":";
}

std::string CmuCamDevice::feed(std::string_view bytes) {
  std::string replies;
  for (const char byte : bytes) {
    if (starting_) break;
    replies += (mode_ & kRawInput) != 0 ? feed_raw(byte) : feed_byte(byte);
  }
  return replies;
}

std::string CmuCamDevice::feed_byte(char byte) {
  tracking_ = false;  // any byte ends a stream
  constexpr std::size_t kLongestLine = 127;
  if (byte == '\n') return {};
  if (byte != '\r') {
    if (model_ == CmuCamModel::kFour && edit(byte)) return {};
    line_ += byte == '\t' ? ' ' : byte;
    if (line_.size() < kLongestLine) return {};
    line_.clear();
    return answer(false);
  }
  const std::string line = std::exchange(line_, {});
  if (!line.empty()) return obey(parsed(line));
  // A lone CR: the older models just prompt.
  return model_ == CmuCamModel::kOne || model_ == CmuCamModel::kTwo ? ":" : answer(true);
}

// Handles bytes of a CMUcam4's line that are no character of a command.
bool CmuCamDevice::edit(char byte) {
  constexpr unsigned char kDelete = 0x7F;
  if (byte == '\b' && !line_.empty()) line_.pop_back();
  const auto code = static_cast<unsigned char>(byte);
  return (code < ' ' && byte != '\t') || code >= kDelete;
}

std::string CmuCamDevice::feed_raw(char byte) {
  tracking_ = false;
  if (raw_.empty() && byte == '\r') return ":";
  raw_ += byte;
  if (raw_.size() < 3) return {};
  const auto count = static_cast<std::size_t>(static_cast<unsigned char>(raw_[2]));
  if (model_ == CmuCamModel::kThree && count > 10) {
    raw_.clear();
    return answer(false);
  }
  if (raw_.size() < 3 + count) return {};
  Command command;
  command.name = raw_.substr(0, 2);
  for (std::size_t i = 3; i < raw_.size(); ++i) {
    const auto value = static_cast<unsigned char>(raw_[i]);
    const bool lowered = model_ == CmuCamModel::kThree && value >= 'a' && value <= 'z';
    command.arguments.push_back(lowered ? value - 32 : value);
  }
  raw_.clear();
  return obey(command);
}

CmuCamDevice::Command CmuCamDevice::parsed(std::string_view line) const {
  Command command;
  std::vector<std::string> words(1);
  for (const char c : line) {
    if (c != ' ') {
      words.back() += c;
    } else if (!words.back().empty()) {
      words.emplace_back();
    }
  }
  if (words.back().empty()) words.pop_back();
  if (words.empty()) return {{}, {}, true};
  for (const char c : words[0]) command.name += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  for (std::size_t i = 1; i < words.size(); ++i) {
    const auto digit = [](char c) { return c >= '0' && c <= '9'; };
    const std::size_t longest = model_ == CmuCamModel::kFour ? 7 : 3;  // a baud rate
    command.bad = command.bad || words[i].size() > longest || !std::all_of(words[i].begin(), words[i].end(), digit);
    if (!command.bad) command.arguments.push_back(std::stoi(words[i]));
  }
  return command;
}

std::string CmuCamDevice::obey(const Command& command) {
  switch (cmucam_judgement(model_, command.name, command.bad ? kNoCount : command.arguments.size())) {
    case CmuCamJudgement::kAct: return act(command);
    case CmuCamJudgement::kRefuse: return answer(false);
    case CmuCamJudgement::kAccept: not_emulated_.note(told_name(command.name)); return answer(true);
    case CmuCamJudgement::kUnknown: not_emulated_.note(told_name(command.name)); return answer(false);
  }
  return {};
}

std::string CmuCamDevice::act(const Command& command) {
  const std::vector<int>& arguments = command.arguments;
  if (command.name == "GV") return answer(true, banner());
  if (command.name == "RS") {
    const std::string acknowledged = (mode_ & kNoAck) != 0 ? "" : "ACK\r";
    const bool silent = (mode_ & kRawOutput) != 0 || model_ == CmuCamModel::kFour;  // which starts with a CR
    const std::string line_end = silent ? "" : "\r";
    reset();
    starting_ = model_ == CmuCamModel::kFour;  // a CMUcam3's program goes on
    return acknowledged + line_end + (starting_ ? "" : greeting());
  }
  // The old rate's answer; the host goes on at the new one with a CR, which is answered like any.
  if (command.name == "BM") {
    if (arguments[0] < kLowestBaud || arguments[0] > kHighestBaud) return answer(false);
    baud_ = static_cast<std::uint32_t>(arguments[0]);
    return "ACK\r";
  }
  if (command.name == "GT") return answer(true, told(bounds_));
  if (command.name == "GW") return answer(true, told(window_));
  if (command.name == "SW" && model_ == CmuCamModel::kFour) {
    if (arguments.size() != 4 && !arguments.empty()) return answer(false);
    std::copy_n(arguments.empty() ? kWholeWindow.data() : arguments.data(), 4, window_);
  }
  if (command.name == "RM") mode_ = arguments[0];
  if (command.name == "PM") polled_ = arguments[0] == 1;
  if (command.name == "MM") reports_middle_ = (arguments[0] & 1) != 0;
  if (command.name == "TC" || command.name == "ST") {
    if (arguments.size() != 6 && !arguments.empty()) return answer(false);
    std::copy(arguments.begin(), arguments.end(), bounds_);
  }
  if (command.name != "TC") return answer(true);
  const bool swapped = bounds_[0] > bounds_[1] || bounds_[2] > bounds_[3] || bounds_[4] > bounds_[5];
  if (swapped && model_ == CmuCamModel::kThree) return answer(true);
  tracking_ = true;
  return (mode_ & kNoAck) != 0 ? "" : "ACK\r";
}

std::string CmuCamDevice::told(std::span<const int> numbers) {
  std::string line;
  for (const int number : numbers) line += (line.empty() ? "" : " ") + std::to_string(number);
  return line + "\r";
}

std::string CmuCamDevice::frame(std::span<const ColouredSpot> spots) {
  if (!tracking_ || starting_) return {};
  tracking_ = !polled_;
  return packet(spots) + (polled_ ? ":" : "");
}

std::string CmuCamDevice::packet(std::span<const ColouredSpot> spots) const {
  Seen seen;
  for (const ColouredSpot& spot : spots) {
    const auto within = [&](int value, int low) { return value >= bounds_[low] && value <= bounds_[low + 1]; };
    if (within(spot.red, 0) && within(spot.green, 2) && within(spot.blue, 4)) add(seen, spot);
  }
  const bool middle = model_ != CmuCamModel::kOne || reports_middle_;
  std::string bytes(1, model_ != CmuCamModel::kOne ? 'T' : (middle ? 'M' : 'C'));
  const bool raw = (mode_ & kRawOutput) != 0;
  for (const int field : fields_of(model_, seen, middle)) {
    bytes += raw ? std::string(1, static_cast<char>(std::min(field, 254))) : " " + std::to_string(field);
  }
  return raw ? "\xFF" + bytes : bytes + "\r";
}

}  // namespace fencepost::emulate
