// The console of a run: its input, its output, and a line that is slow, stuck or unplugged.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

#include "host/live/console_port.hpp"

namespace fencepost::test {

class MemoryConsole final : public host::ConsolePort {
 public:
  /// Keeps what comes out only if it is the log.
  explicit MemoryConsole(bool keep) : keep_(keep) {}

  base::Result<std::size_t> read(std::span<std::uint8_t> in) override {
    if (!plugged_) return base::Error::kGone;
    const std::size_t count = std::min(in.size(), typed_.size());
    if (count == 0) return base::Error::kNotReady;
    std::copy_n(typed_.begin(), count, in.begin());
    typed_.erase(0, count);
    return count;
  }
  base::Result<std::size_t> write(std::span<const std::uint8_t> out) override {
    if (!plugged_) return base::Error::kGone;
    const auto count = std::min<std::size_t>(out.size(), static_cast<std::size_t>(budget_));
    refused_ += count < out.size() ? 1U : 0U;
    if (count == 0) return base::Error::kFull;
    if (keep_) said_.append(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(count));
    budget_ -= static_cast<double>(count);
    return count;
  }
  void tend(base::Time /*now*/) override {}
  [[nodiscard]] bool connected() const override { return plugged_; }
  [[nodiscard]] std::string problem() const override { return {}; }
  [[nodiscard]] int descriptor() const override { return -1; }

  /// Time has passed: a UART's buffer has room for the bytes that were sent meanwhile.
  void pass(base::Duration time) {
    constexpr double kBuffer = 20;  // ms
    budget_ = std::min(budget_ + per_ms_ * static_cast<double>(time.raw) / 10, std::max(1.0, kBuffer * per_ms_));
    if (per_ms_ <= 0) budget_ = 0;
  }
  void set_speed(double bytes_per_ms) { per_ms_ = bytes_per_ms; }
  void set_plugged(bool plugged) {
    plugged_ = plugged;
    if (!plugged) typed_.clear();
  }
  void type(std::string_view text) {
    if (plugged_) typed_ += text;
  }
  void forget_typed() { typed_.clear(); }
  [[nodiscard]] bool read_all() const { return typed_.empty(); }
  /// How often it could not take all that there was.
  [[nodiscard]] std::uint64_t refused() const { return refused_; }
  [[nodiscard]] const std::string& said() const { return said_; }

 private:
  bool keep_;
  bool plugged_ = true;
  double per_ms_ = 0;
  double budget_ = 0;
  std::uint64_t refused_ = 0;
  std::string typed_;
  std::string said_;
};

}  // namespace fencepost::test
