// An I2C adapter of the kernel (i2c-dev): a board's header, or a USB adapter.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "hal/base/result.hpp"
#include "hal/base/units.hpp"
#include "hal/bus/i2c_bus.hpp"
#include "hal/linux/opened.hpp"
#include "hal/linux/retry.hpp"

namespace fencepost::linux {

struct I2cSettings {
  std::string path;  ///< such as /dev/i2c-1
  /// Of one transfer, for adapters that honour it; in steps of 10 ms.
  std::chrono::milliseconds timeout{100};
};

/// Transfers are made by a thread of its own, so that a slow or stuck bus never holds up the loop. After the adapter
/// was gone `tend` opens the path again once it is back.
class I2c {
 public:
  /// errors: a sentence: missing, not allowed, no I2C adapter, or one without repeated starts.
  static Opened<I2c> open(I2cSettings settings);
  /// Waits for a transfer under way, as long as the adapter takes.
  ~I2c();
  I2c(I2c&&) noexcept;
  I2c& operator=(I2c&&) noexcept;
  I2c(const I2c&) = delete;
  I2c& operator=(const I2c&) = delete;

  base::Result<std::size_t> begin(std::uint8_t address, std::span<const std::uint8_t> out, std::size_t expected);
  base::Result<std::size_t> finish(std::span<std::uint8_t> in);

  /// Once per loop iteration; looks for a missing adapter, at most every kRetryInterval.
  void tend(base::Time now);
  [[nodiscard]] bool connected() const;
  /// Why the last try to open it again failed; empty when none did.
  [[nodiscard]] const std::string& problem() const;
  /// For WaitSet: readable once a transfer has ended that `finish` has not answered yet.
  [[nodiscard]] int descriptor() const;

 private:
  class Worker;
  explicit I2c(std::unique_ptr<Worker> worker);
  std::unique_ptr<Worker> worker_;
};

static_assert(bus::I2cBus<I2c>);

}  // namespace fencepost::linux
