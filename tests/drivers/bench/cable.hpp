// A serial line or byte pipe between a driver and a device of host/emulate.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <span>
#include <string_view>
#include <vector>

#include "hal/base/result.hpp"
#include "hal/bus/byte_link.hpp"
#include "hal/fake/stepped_clock.hpp"
#include "tests/drivers/bench/plug.hpp"
#include "tests/drivers/hex.hpp"

namespace fencepost::test {

/// Device: `take(byte, now)` or `feed(text)`, each with a reply. Its output arrives at the line's rate.
template <class Device>
class Cable : public Plug {
 public:
  using IsFrame = bool (*)(std::span<const std::uint8_t>);

  Cable(Device& device, const fake::SteppedClock& clock, const Damage& damage = {})
      : Plug(damage), device_(device), clock_(clock), last_read_(clock.now()) {}

  /// Which of the device's messages are its frames, for whole_frames().
  void count_frames(IsFrame is_frame) { is_frame_ = is_frame; }
  /// 115200 baud is 11.5 bytes a millisecond.
  void set_bytes_per_ms(std::int64_t bytes) { per_ms_ = bytes; }
  void unplug() { Plug::unplug(), forget(); }
  void forget() { waiting_.clear(); }
  /// A device without power neither receives nor sends.
  void power(bool on) { powered_ = on; }
  [[nodiscard]] bool powered() const { return powered_; }

  base::Result<std::size_t> read(std::span<std::uint8_t> in) {
    if (unplugged_) return base::Error::kGone;
    const base::Time now = clock_.now();
    budget_ = std::min<std::int64_t>(budget_ + (now - last_read_).raw * per_ms_ / 10, 4'096);
    last_read_ = now;
    if (waiting_.empty()) budget_ = 0;
    std::size_t count = 0;
    while (!stalled_ && count < in.size() && !waiting_.empty() && budget_ > 0) {
      in[count++] = waiting_.front();
      waiting_.pop_front();
      --budget_;
    }
    if (count == 0) return base::Error::kNotReady;
    return count;
  }

  base::Result<std::size_t> write(std::span<const std::uint8_t> out) {
    if (unplugged_) return base::Error::kGone;
    if (stalled_) return base::Error::kFull;
    // A few bytes at a time, as a full buffer takes them; a pipe takes its packet whole.
    const std::size_t count = std::min<std::size_t>(out.size(), 64);
    for (const std::uint8_t byte : out.first(count)) {
      const std::uint8_t heard = corruptor_.pass(byte);
      if (powered_) inject(answer(heard));
    }
    return count;
  }

  /// The device's output, requested or not. Beyond its capacity, like a port's buffer, the line drops bytes.
  void inject(const std::vector<std::uint8_t>& bytes) {
    if (!powered_) return;
    const std::uint64_t before = corrupted();
    noise(bytes);
    if (is_frame_ != nullptr && !bytes.empty() && !unplugged_ && is_frame_(bytes) && corrupted() == before)
      ++whole_frames_;
  }
  void inject(std::string_view bytes) { inject(bytes_of(bytes)); }
  /// Bytes that arrive without having been sent by the device.
  void noise(const std::vector<std::uint8_t>& bytes) {
    for (const std::uint8_t byte : bytes) {
      if (!unplugged_ && waiting_.size() < kCapacity) waiting_.push_back(corruptor_.pass(byte));
    }
  }

  [[nodiscard]] std::size_t waiting() const { return waiting_.size(); }

 private:
  static constexpr std::size_t kCapacity = 16'384;

  std::vector<std::uint8_t> answer(std::uint8_t byte) {
    if constexpr (requires { device_.take(byte, clock_.now()); }) {
      return device_.take(byte, clock_.now());
    } else {
      const char c = static_cast<char>(byte);
      return bytes_of(device_.feed(std::string_view(&c, 1)));
    }
  }

  Device& device_;
  const fake::SteppedClock& clock_;
  IsFrame is_frame_ = nullptr;
  std::deque<std::uint8_t> waiting_;
  std::int64_t per_ms_ = 12;
  std::int64_t budget_ = 0;
  base::Time last_read_;
  bool powered_ = true;
};

}  // namespace fencepost::test
