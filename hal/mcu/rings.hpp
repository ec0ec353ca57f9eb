// The two rings of a serial line, as the loop sees them: a ByteLink. The port adds the interrupt's side.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/base/result.hpp"
#include "hal/bus/byte_link.hpp"
#include "hal/mcu/byte_ring.hpp"

namespace fencepost::mcu {

template <std::size_t kReceive, std::size_t kSend>
class Rings {
 public:
  /// kBadInput, once, after bytes were lost: an overrun of the part or of the ring, a framing error.
  base::Result<std::size_t> read(std::span<std::uint8_t> in) {
    const std::uint16_t lost = lost_.load(std::memory_order_relaxed);
    if (lost != told_) {
      told_ = lost;
      return base::Error::kBadInput;
    }
    std::size_t count = 0;
    while (count < in.size() && received_.get(in[count])) ++count;
    if (count == 0 && !in.empty()) return base::Error::kNotReady;
    return count;
  }
  /// Takes what fits; the owner of the line then has to start sending.
  base::Result<std::size_t> write(std::span<const std::uint8_t> out) {
    std::size_t count = 0;
    while (count < out.size() && sending_.put(out[count])) ++count;
    if (count == 0 && !out.empty()) return base::Error::kFull;
    return count;
  }

  /// Bytes that write() would take now.
  [[nodiscard]] std::size_t room() const { return kSend - sending_.size(); }

  /// The interrupt's side.
  void received(std::uint8_t byte) {
    if (!received_.put(byte)) lost();
  }
  void lost() {
    lost_.store(static_cast<std::uint16_t>(lost_.load(std::memory_order_relaxed) + 1), std::memory_order_relaxed);
  }
  [[nodiscard]] bool next(std::uint8_t& byte) { return sending_.get(byte); }

  /// Bytes wait for the loop.
  [[nodiscard]] bool waiting() const { return !received_.empty(); }
  /// Of those that came.
  [[nodiscard]] std::size_t receive_room() const { return kReceive - received_.size(); }

 private:
  ByteRing<kReceive> received_;
  ByteRing<kSend> sending_;
  std::atomic<std::uint16_t> lost_{0};  ///< times; written by the interrupt only
  std::uint16_t told_ = 0;
};

static_assert(bus::ByteLink<Rings<2, 2>>);

}  // namespace fencepost::mcu
