#include "host/emulate/models/grove.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <sstream>
#include <utility>

namespace fencepost::emulate {
namespace {

constexpr std::size_t kMaxLine = 4'095;
constexpr std::size_t kMaxName = 24;
constexpr int kScore = 90;

std::string reply(int type, const std::string& name, int code, const std::string& data) {
  return "\r{\"type\": " + std::to_string(type) + ", \"name\": \"" + name + "\", \"code\": " + std::to_string(code) +
         ", \"data\": " + data + "}\n";
}

}  // namespace

Bytes Grove::power_up(base::Time now) {
  power_on_ = now;
  line_.clear();
  left_ = 0;
  results_ = 0;
  return {};
}

Bytes Grove::take(std::uint8_t byte, base::Time now) {
  if (!awake(now)) return {};
  const char c = static_cast<char>(byte);
  if (c != '\r' && c != '\n') {
    line_ += c;
    if (line_.size() > kMaxLine) line_.clear();
    return {};
  }
  const std::string line = std::exchange(line_, {});
  return line.starts_with("AT+") ? bytes_of(obey(line.substr(3))) : Bytes{};
}

std::string Grove::obey(const std::string& command) {
  if (command == "ID?") return reply(0, command, 0, "\"7e2d02cf\"");
  if (command == "NAME?") return reply(0, command, 0, "\"Grove Vision AI V2\"");
  if (command == "VER?") return reply(0, command, 0, R"({"at_api": "v0", "software": "2024.08.16", "hardware": "1"})");
  if (command == "STAT?") return reply(0, command, 0, R"({"boot_count": 1, "is_ready": 1})");
  if (command == "INVOKE?") return reply(0, command, 0, left_ == 0 ? "0" : "1");
  if (command == "BREAK") {
    left_ = 0;
    return reply(0, command, 0, "0");
  }
  constexpr std::string_view kInvoke = "INVOKE=";
  if (command.starts_with(kInvoke)) return invoke(command.substr(kInvoke.size()));
  const bool plain = command.size() < kMaxName && std::all_of(command.begin(), command.end(), [](char c) {
                       return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '?' || c == '=' || c == ',';
                     });
  not_emulated_.note(plain ? command.substr(0, command.find('=')) : "unreadable bytes");
  return reply(2, "AT", 5, "\"Unknown command\"");
}

std::string Grove::invoke(const std::string& arguments) {
  int times = 0;
  int differed = 0;
  int result_only = 0;
  char first_comma = 0;
  char second_comma = 0;
  std::istringstream words(arguments);
  words >> times >> first_comma >> differed >> second_comma >> result_only;
  if (!words || !words.eof() || first_comma != ',' || second_comma != ',' || times < -1) {
    return reply(2, "AT", 5, "\"Arguments\"");
  }
  if (differed != 0) not_emulated_.note("INVOKE of what differs");
  if (result_only == 0) not_emulated_.note("INVOKE with pictures");
  left_ = times;
  used_ = used_ || times != 0;
  return reply(0, "INVOKE", 0,
               R"({"model": {"id": 1, "type": 3, "address": 4194304, "size": 267024}, "algorithm": {"type": 3, )"
               R"("category": 1, "input_from": 1, "config": {"tscore": 60, "tiou": 50}}, "sensor": {"id": 1, "type": )"
               R"(1, "state": 1}})");
}

Bytes Grove::see(const sensor::BlobFrame& frame, base::Time now) {
  if (!awake(now) || left_ == 0) return {};
  if (left_ > 0) --left_;
  std::string boxes;
  for (const sensor::Blob& blob : frame.blobs) {
    const int width = blob.x2 - blob.x1 + 1;
    const int height = blob.y2 - blob.y1 + 1;
    std::array<char, 64> box{};
    std::snprintf(box.data(), box.size(), "%s[%d, %d, %d, %d, %d, %d]", boxes.empty() ? "" : ", ", blob.x1 + width / 2,
                  blob.y1 + height / 2, width, height, kScore, blob.signature - 1);
    boxes += box.data();
  }
  return bytes_of(reply(1, "INVOKE", 0,
                        "{\"count\": " + std::to_string(results_++) + ", \"perf\": [6, 54, 1], \"boxes\": [" + boxes +
                            "], \"resolution\": [" + std::to_string(width_) + ", " + std::to_string(height_) + "]}"));
}

void GroveOnI2c::say(const Bytes& bytes) {
  constexpr std::size_t kMaxWaiting = 4'096;
  if (waiting_.size() + bytes.size() <= kMaxWaiting) waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
}

std::optional<std::vector<std::uint8_t>> GroveOnI2c::transfer(std::uint8_t address,
                                                              const std::vector<std::uint8_t>& out,
                                                              std::size_t expected, base::Time now) {
  constexpr std::uint8_t kAddress = 0x62;
  constexpr std::uint8_t kTransport = 0x10;
  if (address != kAddress || !device_.awake(now)) return std::nullopt;
  std::vector<std::uint8_t> in;
  if (std::exchange(count_asked_, false) && expected > 0) {
    in = {static_cast<std::uint8_t>(waiting_.size() >> 8U), static_cast<std::uint8_t>(waiting_.size() & 0xFFU)};
  } else if (asked_ > 0 && expected > 0) {
    const std::size_t size = std::min(std::exchange(asked_, 0), waiting_.size());
    in.assign(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(size));
    waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(size));
  }
  in.resize(expected);
  if (out.size() < 4 || out[0] != kTransport) return in;
  const std::size_t length = 256U * out[2] + out[3];
  if (out[1] == 0x01) asked_ = length;
  if (out[1] == 0x03) count_asked_ = true;
  if (out[1] == 0x02) {
    for (std::size_t i = 4; i < out.size() && i < 4 + length; ++i) say(device_.take(out[i], now));
  }
  return in;
}

}  // namespace fencepost::emulate
