// A log as long as a test wants, of a robot that goes to and fro before a box and never stops. Its own program's prints
// are in it. It is one run, so nothing may be forgotten at a new one.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <fstream>
#include <string>

#include "hal/base/crc16.hpp"

namespace fencepost::host::testing {

inline std::string record_line(const std::string& body) {
  return fmt::format("${}*{:04X}\r\n", body, base::crc16(body));
}

class LongLog {
 public:
  /// A pose each `tick` s. A record's time ends at a million: of 4 GB that takes poses close to each other.
  explicit LongLog(double tick = 0.05) : tick_seconds_(tick) {}

  /// The lines before the drive: its camera looks ahead from 0.1 m.
  static std::string begin() {
    return record_line("FPHDR,1,test,1,none,full") +
           record_line(
               "FPCAM,pixy2,316,208,273.60,273.60,157.50,103.50,0.0000,0.0000,0.0000,0.1000,0.0000,0.0000,0.0000") +
           record_line("FPSIG,1,d02020,red");
  }

  /// The next two poses.
  std::string next() {
    std::string text = fmt::format("{:200}\n", "what a program of the robot's own prints");
    for (int i = 0; i < 2; ++i) {
      tick_ += 1;
      text += record_line(fmt::format("FPODO,{:.4f},{:.4f},0.0000,0.0000", time(), place()));
    }
    if (tick_ % 10 == 0) text += frame();
    return text;
  }

 private:
  static constexpr double kFront = 2.0;  // m, of the box, 0.1 wide and 0.2 high
  static constexpr double kFocal = 273.6;

  [[nodiscard]] double time() const { return tick_seconds_ * static_cast<double>(tick_); }
  /// 10 s there and 10 s back.
  [[nodiscard]] double place() const {
    const double phase = std::fmod(time(), 20);
    return 0.15 * (phase < 10 ? phase : 20 - phase);
  }
  std::string frame() {
    const double depth = kFront - place();
    const auto column = [&](double y) { return static_cast<int>(std::lround(157.5 - kFocal * y / depth)); };
    const auto row = [&](double z) { return static_cast<int>(std::lround(103.5 + kFocal * (0.1 - z) / depth)); };
    const int right = column(-0.05);
    const int left = column(0.05);
    return record_line(fmt::format("FPFRM,{:.4f},{},1,1,{},{},{},{},{:.1f},{:.1f},{},", time(), ++frame_, left,
                                   row(0.2), right, row(0), 0.5 * (left + right), 0.5 * (row(0.2) + row(0)),
                                   (right - left) * (row(0) - row(0.2))));
  }

  double tick_seconds_;
  std::uint64_t tick_ = 0;
  std::uint32_t frame_ = 0;
};

/// A file of at least `bytes`.
inline void write_long_log(const std::string& path, std::uint64_t bytes, LongLog log = LongLog()) {
  std::ofstream file(path, std::ios::binary);
  file << LongLog::begin();
  for (std::uint64_t size = 0; size < bytes;) {
    const std::string part = log.next();
    file << part;
    size += part.size();
  }
}

}  // namespace fencepost::host::testing
