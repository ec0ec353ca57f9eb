#include "host/emulate/models/jevois.hpp"
#include "host/emulate/models/bytes.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <utility>

namespace fencepost::emulate {
namespace {

constexpr int kMaxDecimals = 10;
constexpr std::size_t kLongestName = 24;

bool one_of(const std::string& word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

// A value between -0.5 and 0 rounds to -0, as the real one writes it.
std::string number(double value, int decimals) {
  std::array<char, 64> text{};
  const double scale = std::pow(10, decimals);
  const int size = std::snprintf(text.data(), text.size(), "%.*f", decimals, std::round(value * scale) / scale);
  return {text.data(), static_cast<std::size_t>(size)};
}

}  // namespace

void JeVois::load_module() {
  style_ = "Terse";
  decimals_ = 0;
  stamps_ = marks_ = "None";
  limit_ = 0;
}

Bytes JeVois::power_up(base::Time now) {
  load_module();
  power_on_ = now;
  line_.clear();
  output_ = "None";
  streaming_ = false;
  images_ = 0;
  return {};
}

Bytes JeVois::take(std::uint8_t byte, base::Time now) {
  if (now - power_on_ < kBoot) return {};
  const char c = static_cast<char>(byte);
  if (c != '\r' && c != '\n') {
    line_ += c;
    constexpr std::size_t kLongest = 1'000;
    if (line_.size() > kLongest) line_.clear();
    return {};
  }
  const std::string command = std::exchange(line_, {});
  return command.empty() ? Bytes{} : bytes_of(obey(command));
}

std::string JeVois::obey(const std::string& command) {
  std::istringstream words(command);
  std::string verb;
  std::string name;
  std::string value;
  words >> verb >> name >> value;
  if (verb == "ping") return "ALIVE\r\nOK\r\n";
  if (verb == "streamon" || verb == "streamoff") {
    streaming_ = verb == "streamon";
    used_ = used_ || (streaming_ && output_ != "None");
    return "OK\r\n";
  }
  if (verb == "setpar" && set(name, value)) return "OK\r\n";
  const std::string asked = verb == "setpar" ? verb + " " + name : verb;
  const bool plain = asked.size() < kLongestName && std::all_of(asked.begin(), asked.end(), [](char c) {
                       return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == ' ';
                     });
  not_emulated_.note(plain ? asked : "unreadable bytes");
  if (asked == "setpar serlog") return "OK\r\n";
  if (asked == "setmapping2" && !streaming_) {
    load_module();
    return "OK\r\n";
  }
  return "ERR Command error\r\n";
}

bool JeVois::set(const std::string& name, const std::string& value) {
  const auto take = [&value](std::string& into, std::initializer_list<std::string_view> words) {
    const bool known = one_of(value, words);
    if (known) into = value;
    return known;
  };
  if (name == "serout") return take(output_, {"None", "All", "Hard", "USB"});
  if (name == "serstyle") return take(style_, {"Terse", "Normal", "Detail", "Fine"});
  if (name == "serstamp") return take(stamps_, {"None", "Frame", "Time", "FrameTime", "FrameDateTime"});
  if (name == "sermark") return take(marks_, {"None", "Start", "Stop", "Both"});
  const bool digits = !value.empty() && value.size() < 4 && value.find_first_not_of("0123456789") == std::string::npos;
  if (!digits) return false;
  if (name == "serlimit") {
    limit_ = std::stoi(value);
    return true;
  }
  if (name != "serprec" || std::stoi(value) > kMaxDecimals) return false;
  decimals_ = std::stoi(value);
  return true;
}

// Its clock starts at midnight, on the first day of 2016 here: it has no battery.
std::string JeVois::stamp() const {
  const std::string number = std::to_string(images_);
  if (stamps_ == "Frame") return number + " ";
  if (stamps_ == "Time") return "00:00:00 ";
  if (stamps_ == "FrameTime") return number + "/00:00:00 ";
  if (stamps_ == "FrameDateTime") return number + "/2016-01-01/00:00:00 ";
  return {};
}

std::string JeVois::message(const sensor::Blob& blob) const {
  const auto x = [&](double edge) { return " " + number(2'000 * edge / width_ - 1'000, decimals_); };
  const auto y = [&](double edge) { return " " + number(0.75 * (2'000 * edge / height_ - 1'000), decimals_); };
  const double width = blob.x2 - blob.x1 + 1;
  const double height = blob.y2 - blob.y1 + 1;
  const double middle_x = blob.x1 + width / 2;
  const double middle_y = blob.y1 + height / 2;
  const std::string id = " blob" + std::to_string(blob.signature);
  if (style_ == "Terse") return "T2" + x(middle_x) + y(middle_y);
  if (style_ == "Normal") {
    return "N2" + id + x(middle_x) + y(middle_y) + " " + number(2'000 * width / width_, decimals_) + " " +
           number(0.75 * 2'000 * height / height_, decimals_);
  }
  // The fourth vertex repeats the second one, in its sources.
  const std::string second = x(blob.x2 + 1.0) + y(blob.y1);
  const std::string count = style_ == "Fine" ? " 4" : "";
  return style_.substr(0, 1) + "2" + id + count + x(blob.x1) + y(blob.y1) + second + x(blob.x2 + 1.0) +
         y(blob.y2 + 1.0) + second;
}

Bytes JeVois::see(const sensor::BlobFrame& frame, base::Time now) {
  if (now - power_on_ < kBoot) return {};
  ++images_;
  if (!streaming_ || output_ == "None") return {};
  std::string text;
  const auto say = [&](const std::string& line) { text += stamp() + line + "\r\n"; };
  if (marks_ == "Start" || marks_ == "Both") say("MARK START");
  int said = 0;
  for (const sensor::Blob& blob : frame.blobs) {
    if (limit_ > 0 && said++ == limit_) break;
    say(message(blob));
  }
  if (marks_ == "Stop" || marks_ == "Both") say("MARK STOP");
  return bytes_of(text);
}

}  // namespace fencepost::emulate
