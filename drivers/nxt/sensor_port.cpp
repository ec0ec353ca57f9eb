#include "drivers/nxt/sensor_port.hpp"

#include <algorithm>

namespace fencepost::nxt {
namespace {

// All three as in other host libraries.
constexpr base::Duration kSettleTime = base::milliseconds(100);  // after the port's set-up
constexpr base::Duration kPollPause = base::milliseconds(10);    // between two requests for the status
constexpr std::uint8_t kPolls = 30;                              // before the transfer fails

}  // namespace

base::Result<std::size_t> SensorPort::begin(std::uint8_t address, std::span<const std::uint8_t> out,
                                            std::size_t expected) {
  if (conversation_.link() == sensor::LinkState::kAbsent && step_ == Step::kIdle) return base::Error::kGone;
  const bool fits = out.size() < kMaxSensorBytes && expected <= kMaxSensorBytes;
  // An exchange left over by an unfinished transfer has to end first.
  if (step_ != Step::kIdle || !fits) return base::Error::kFull;
  write_ = sensor_write(port_, address, out, expected);
  expected_ = static_cast<std::uint8_t>(expected);
  polls_ = 0;
  advance(!set_up_ ? Step::kSetUp : stale_ ? Step::kClear : Step::kWrite, {});
  return out.size();
}

base::Result<std::size_t> SensorPort::finish(std::span<std::uint8_t> in) {
  if (step_ == Step::kIdle || exchange_.under_way()) return base::Error::kNotReady;
  if (exchange_.state == Exchange::State::kFailed) {
    set_up_ = false;
    return fail(conversation_.link() == sensor::LinkState::kAbsent ? base::Error::kGone : base::Error::kRefused);
  }
  if (exchange_.state == Exchange::State::kDone) return take_reply(in);
  if (conversation_.now() < not_before_) return base::Error::kNotReady;
  if (step_ == Step::kSettle) return advance(Step::kClear, {});
  exchange_.request = request();
  // Full: next time.
  (void)conversation_.submit(exchange_);
  return base::Error::kNotReady;
}

Telegram SensorPort::request() const {
  switch (step_) {
    case Step::kSetUp: return set_i2c_port(port_);
    case Step::kWrite: return write_;
    case Step::kStatus: return sensor_status(port_);
    default: return sensor_read(port_);
  }
}

base::Result<std::size_t> SensorPort::take_reply(std::span<std::uint8_t> in) {
  const Reply reply = exchange_.reply();
  if (reply.status == status::kNotConfigured || reply.status == status::kOutOfRange) {
    // After set-up a port without data says so too: only a read may.
    if (step_ == Step::kClear) return advance(Step::kWrite, {});
    set_up_ = false;
    return fail(base::Error::kRefused);
  }
  const bool may_pend = step_ == Step::kStatus || step_ == Step::kClear || reply.status == status::kOk;
  if (!may_pend || (reply.status != status::kOk && reply.status != status::kPending && step_ != Step::kClear)) {
    return fail(base::Error::kRefused);
  }
  switch (step_) {
    case Step::kSetUp: set_up_ = true; return advance(Step::kSettle, kSettleTime);
    case Step::kClear: stale_ = false; return advance(Step::kWrite, {});
    case Step::kWrite: return advance(Step::kStatus, {});
    case Step::kStatus: return take_status(reply);
    default: return take_bytes(reply, in);
  }
}

base::Result<std::size_t> SensorPort::take_status(const Reply& reply) {
  const bool ready = reply.status == status::kOk && ready_bytes_of(reply) >= expected_;
  if (!ready) return ++polls_ == kPolls ? fail(base::Error::kRefused) : advance(Step::kStatus, kPollPause);
  if (expected_ > 0) return advance(Step::kRead, {});
  step_ = Step::kIdle;
  return std::size_t{0};
}

base::Result<std::size_t> SensorPort::take_bytes(const Reply& reply, std::span<std::uint8_t> in) {
  const std::span<const std::uint8_t> bytes = sensor_bytes_of(reply);
  if (bytes.size() < expected_ || in.size() < expected_) return fail(base::Error::kRefused);
  std::copy_n(bytes.begin(), expected_, in.begin());
  step_ = Step::kIdle;
  return std::size_t{expected_};
}

base::Error SensorPort::advance(Step step, base::Duration pause) {
  step_ = step;
  not_before_ = conversation_.now() + pause;
  exchange_.state = Exchange::State::kIdle;
  return base::Error::kNotReady;
}

base::Error SensorPort::fail(base::Error error) {
  stale_ = true;
  step_ = Step::kIdle;
  return error;
}

}  // namespace fencepost::nxt
