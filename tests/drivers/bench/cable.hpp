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

/// All of a cable that does not depend on the device. The device's output arrives at the line's rate.
class Line : public Plug {
 public:
  using IsFrame = bool (*)(std::span<const std::uint8_t>);

  Line(const fake::SteppedClock& clock, const Damage& damage) : Plug(damage), clock_(clock), last_read_(clock.now()) {}

  /// Which of the device's messages are its frames, for whole_frames().
  void count_frames(IsFrame is_frame) { is_frame_ = is_frame; }
  /// 115200 baud is 11.5 bytes a millisecond.
  void set_bytes_per_ms(std::int64_t bytes) { per_ms_ = bytes; }
  void unplug() { Plug::unplug(), forget(); }
  void forget() { waiting_.clear(); }
  /// A device without power neither receives nor sends.
  void power(bool on) { powered_ = on; }
  [[nodiscard]] bool powered() const { return powered_; }
  /// The byte behind the next `bytes` arrives at another poll than they do.
  void split_after(std::size_t bytes) { split_ = static_cast<std::int64_t>(bytes); }

  base::Result<std::size_t> read(std::span<std::uint8_t> in) {
    if (unplugged_) return base::Error::kGone;
    const base::Time now = clock_.now();
    budget_ = std::min<std::int64_t>(budget_ + (now - last_read_).raw * per_ms_ / 10, 4'096);
    if (split_ == 0 && now == last_read_) return base::Error::kNotReady;
    if (split_ == 0) split_ = -1;
    last_read_ = now;
    if (waiting_.empty()) budget_ = 0;
    std::size_t count = 0;
    while (!stalled_ && split_ != 0 && count < in.size() && !waiting_.empty() && budget_ > 0) {
      in[count++] = waiting_.front();
      waiting_.pop_front();
      --budget_;
      if (split_ > 0) --split_;
    }
    if (count == 0) return base::Error::kNotReady;
    return count;
  }

  /// The device's output, requested or not. Beyond its capacity, like a port's buffer, the line drops bytes.
  void inject(const std::vector<std::uint8_t>& bytes) {
    if (!powered_) return;
    if (is_frame_ == nullptr || bytes.empty() || unplugged_ || !is_frame_(bytes)) return noise(bytes);
    const std::uint64_t before = corrupted();
    const std::vector<std::uint8_t> sent = tampered(bytes);
    noise(sent);
    if (sent == bytes && corrupted() == before) ++whole_frames_;
  }
  void inject(std::string_view bytes) { inject(bytes_of(bytes)); }
  /// Bytes that arrive without having been sent by the device.
  void noise(const std::vector<std::uint8_t>& bytes) {
    for (const std::uint8_t byte : bytes) {
      if (!unplugged_ && waiting_.size() < kCapacity) waiting_.push_back(corruptor_.pass(byte));
    }
  }

  [[nodiscard]] std::size_t waiting() const { return waiting_.size(); }

 protected:
  [[nodiscard]] base::Time now() const { return clock_.now(); }

 private:
  static constexpr std::size_t kCapacity = 16'384;

  const fake::SteppedClock& clock_;
  IsFrame is_frame_ = nullptr;
  std::deque<std::uint8_t> waiting_;
  std::int64_t per_ms_ = 12;
  std::int64_t budget_ = 0;
  base::Time last_read_;
  bool powered_ = true;
  std::int64_t split_ = -1;  ///< bytes until the split; none is due if negative
};

/// Device: `take(byte, now)` or `feed(text)`, each with a reply.
template <class Device>
class Cable : public Line {
 public:
  Cable(Device& device, const fake::SteppedClock& clock, const Damage& damage = {})
      : Line(clock, damage), device_(device) {}

  base::Result<std::size_t> write(std::span<const std::uint8_t> out) {
    if (unplugged_) return base::Error::kGone;
    if (stalled_) return base::Error::kFull;
    // A few bytes at a time, as a full buffer takes them; a pipe takes its packet whole.
    const std::size_t count = std::min<std::size_t>(out.size(), 64);
    hear(out.first(count));
    for (const std::uint8_t byte : out.first(count)) {
      const std::uint8_t heard = corruptor_.pass(byte);
      if (powered()) inject(answer(heard));
    }
    return count;
  }

 private:
  std::vector<std::uint8_t> answer(std::uint8_t byte) {
    if constexpr (requires { device_.take(byte, now()); }) {
      return device_.take(byte, now());
    } else {
      const char c = static_cast<char>(byte);
      return bytes_of(device_.feed(std::string_view(&c, 1)));
    }
  }

  Device& device_;
};

}  // namespace fencepost::test
