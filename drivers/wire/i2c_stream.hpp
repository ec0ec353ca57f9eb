// A byte link made of an I2C device that takes and gives a stream of bytes, without registers.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "hal/bus/byte_link.hpp"
#include "hal/bus/i2c_bus.hpp"

namespace fencepost::wire {

/// Each call does at most one step of a transfer. A read that finds the bus free begins one and returns kNotReady; a
/// later read gives its bytes. A missing acknowledgement is kNotReady too: a device that is starting, or absent, is
/// silent. A write that found the bus busy gets it next, if it is retried before the second read after that. Without
/// this rule a caller that reads until nothing is left would always have started the next read.
template <bus::I2cBus Bus>
class I2cStream {
 public:
  /// Bytes that the Arduino library of the Pixy2, and the narrowest bus, take at once.
  static constexpr std::size_t kChunk = 16;

  I2cStream(Bus& bus, std::uint8_t address) : bus_(bus), address_(address) {}

  base::Result<std::size_t> read(std::span<std::uint8_t> in) {
    if (next_ == end_) {
      if (const auto error = advance(); error != base::Error::kNotReady) return error;
    }
    if (next_ == end_) return base::Error::kNotReady;
    const std::size_t count = std::min(in.size(), end_ - next_);
    std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(next_), count, in.begin());
    next_ += count;
    return count;
  }

  base::Result<std::size_t> write(std::span<const std::uint8_t> out) {
    if (busy_) {
      if (const auto error = collect(); error != base::Error::kNotReady) return error;
      write_waits_ = busy_;
      if (busy_) return base::Error::kFull;
    }
    write_waits_ = false;
    const base::Result<std::size_t> begun = bus_.begin(address_, out.first(std::min(out.size(), kChunk)), 0);
    busy_ = begun.ok();
    reading_ = false;
    return begun;
  }

 private:
  // kNotReady: nothing worse than that.
  base::Error advance() {
    if (busy_) return collect();
    if (std::exchange(write_waits_, false)) return base::Error::kNotReady;
    const base::Result<std::size_t> begun = bus_.begin(address_, {}, kChunk);
    busy_ = begun.ok();
    reading_ = true;
    return !begun && begun.error() == base::Error::kGone ? base::Error::kGone : base::Error::kNotReady;
  }

  base::Error collect() {
    std::array<std::uint8_t, kChunk> in{};
    const base::Result<std::size_t> got = bus_.finish(in);
    if (!got && got.error() == base::Error::kNotReady) return base::Error::kNotReady;
    busy_ = false;
    if (!got) return got.error() == base::Error::kGone ? base::Error::kGone : base::Error::kNotReady;
    if (reading_) keep(std::span<const std::uint8_t>(in).first(std::min(*got, kChunk)));
    return base::Error::kNotReady;
  }

  // The reader has taken what was there before: a read is begun only then, and there is one at a time.
  void keep(std::span<const std::uint8_t> bytes) {
    std::copy(bytes.begin(), bytes.end(), bytes_.begin());
    next_ = 0;
    end_ = bytes.size();
  }

  Bus& bus_;
  std::uint8_t address_;
  bool busy_ = false;
  bool reading_ = false;
  bool write_waits_ = false;
  std::array<std::uint8_t, kChunk> bytes_{};
  std::size_t next_ = 0;
  std::size_t end_ = 0;
};

}  // namespace fencepost::wire
