// A sensor port of the brick as an I2C bus.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "drivers/nxt/conversation.hpp"
#include "hal/bus/i2c_bus.hpp"

namespace fencepost::nxt {

/// A transfer is: port set up once (and 100 ms to settle), LSWRITE, LSGETSTATUS every 10 ms until the bytes are there,
/// LSREAD. Writes at most 15 bytes, reads at most 16. Each call of `finish` goes one step on; the time is that of the
/// brick's last poll.
class SensorPort {
 public:
  /// `port` 0 to 3, printed 1 to 4 on the brick.
  SensorPort(Conversation& conversation, std::uint8_t port) : conversation_(conversation), port_(port) {}

  base::Result<std::size_t> begin(std::uint8_t address, std::span<const std::uint8_t> out, std::size_t expected);
  base::Result<std::size_t> finish(std::span<std::uint8_t> in);

 private:
  enum class Step : std::uint8_t { kIdle, kSetUp, kSettle, kClear, kWrite, kStatus, kRead };

  [[nodiscard]] Telegram request() const;
  base::Result<std::size_t> take_reply(std::span<std::uint8_t> in);
  base::Result<std::size_t> take_status(const Reply& reply);
  base::Result<std::size_t> take_bytes(const Reply& reply, std::span<std::uint8_t> in);
  base::Error advance(Step step, base::Duration pause);
  base::Error fail(base::Error error);

  Conversation& conversation_;
  std::uint8_t port_;
  Step step_ = Step::kIdle;
  bool set_up_ = false;
  bool stale_ = true;  ///< the brick may hold bytes of a transfer that failed
  std::uint8_t polls_ = 0;
  std::uint8_t expected_ = 0;
  base::Time not_before_;
  Telegram write_;
  Exchange exchange_;
};

static_assert(bus::I2cBus<SensorPort>);

}  // namespace fencepost::nxt
