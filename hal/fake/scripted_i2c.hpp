// An I2C bus that plays a script: one answer a transfer, and keeps what was asked.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "hal/base/fixed.hpp"
#include "hal/bus/i2c_bus.hpp"

namespace fencepost::fake {

/// Result of one transfer: bytes read, or an error; first `turns` times kNotReady.
struct I2cStep {
  std::span<const std::uint8_t> bytes;
  std::optional<base::Error> error;
  int turns = 0;
};

/// One transfer as it was begun.
struct I2cTransfer {
  std::uint8_t address = 0;
  base::FixedVector<std::uint8_t, bus::kMaxI2cTransfer> out;
  std::size_t expected = 0;
  friend constexpr bool operator==(const I2cTransfer&, const I2cTransfer&) = default;
};

/// After the script nobody acknowledges any more. At most `Capacity` transfers are kept.
template <std::size_t Capacity>
class ScriptedI2c {
 public:
  /// The script and its bytes are borrowed.
  constexpr explicit ScriptedI2c(std::span<const I2cStep> script) : script_(script) {}

  constexpr base::Result<std::size_t> begin(std::uint8_t address, std::span<const std::uint8_t> out,
                                            std::size_t expected) {
    if (gone_) return base::Error::kGone;
    if (busy_ || out.size() > bus::kMaxI2cTransfer || expected > bus::kMaxI2cTransfer) return base::Error::kFull;
    I2cTransfer transfer{address, {}, expected};
    for (const std::uint8_t byte : out) (void)transfer.out.push_back(byte);
    (void)transfers_.push_back(transfer);
    busy_ = true;
    turns_ = 0;
    return out.size();
  }

  constexpr base::Result<std::size_t> finish(std::span<std::uint8_t> in) {
    if (gone_) {
      busy_ = false;
      return base::Error::kGone;
    }
    if (!busy_) return base::Error::kNotReady;
    if (step_ == script_.size()) {
      busy_ = false;
      return base::Error::kRefused;
    }
    const I2cStep& step = script_[step_];
    if (turns_++ < step.turns) return base::Error::kNotReady;
    ++step_;
    busy_ = false;
    if (step.error) return *step.error;
    const std::size_t count = std::min({in.size(), step.bytes.size(), transfers_[transfers_.size() - 1].expected});
    std::copy_n(step.bytes.begin(), count, in.begin());
    return count;
  }

  constexpr void unplug() { gone_ = true; }
  constexpr void replug() { gone_ = false; }

  [[nodiscard]] constexpr std::span<const I2cTransfer> transfers() const { return transfers_.view(); }
  [[nodiscard]] constexpr bool finished() const { return step_ == script_.size(); }

 private:
  std::span<const I2cStep> script_;
  std::size_t step_ = 0;
  int turns_ = 0;
  bool busy_ = false;
  bool gone_ = false;
  base::FixedVector<I2cTransfer, Capacity> transfers_;
};

static_assert(bus::I2cBus<ScriptedI2c<4>>);

}  // namespace fencepost::fake
