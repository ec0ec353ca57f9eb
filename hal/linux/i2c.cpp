#include "hal/linux/i2c.hpp"

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

#include "hal/linux/i2c_adapter.hpp"
#include "hal/linux/signal_flag.hpp"

namespace fencepost::linux {

using base::Error;
using base::Result;

/// Owns the adapter. The loop's side and the thread take turns with `transfer_`, by `state_`.
class I2c::Worker {
 public:
  Worker(I2cSettings settings, Descriptor adapter, SignalFlag done)
      : settings_(std::move(settings)),
        adapter_(std::move(adapter)),
        done_(std::move(done)),
        thread_([this] { run(); }) {}
  ~Worker() {
    {
      const std::lock_guard lock(mutex_);
      stop_ = true;
    }
    wake_.notify_one();
    thread_.join();
  }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  Result<std::size_t> begin(std::uint8_t address, std::span<const std::uint8_t> out, std::size_t expected) {
    if (!adapter_.open()) return Error::kGone;
    if (out.size() > bus::kMaxI2cTransfer || expected > bus::kMaxI2cTransfer) return Error::kFull;
    {
      const std::lock_guard lock(mutex_);
      if (state_ != State::kIdle) return Error::kFull;
      transfer_ = I2cTransfer{};
      transfer_.address = address;
      for (const std::uint8_t byte : out) static_cast<void>(transfer_.out.push_back(byte));
      transfer_.expected = expected;
      state_ = State::kUnderWay;
    }
    wake_.notify_one();
    return out.size();
  }

  Result<std::size_t> finish(std::span<std::uint8_t> in) {
    if (!adapter_.open()) return Error::kGone;
    const std::lock_guard lock(mutex_);
    if (state_ != State::kDone) return Error::kNotReady;
    state_ = State::kIdle;
    done_.clear();
    // An adapter that is gone cannot leave the kernel before it is closed.
    if (!answer_ && answer_.error() == Error::kGone) adapter_.close();
    if (!answer_) return answer_;
    const std::size_t count = std::min(in.size(), *answer_);
    std::copy_n(transfer_.in.begin(), count, in.begin());
    return count;
  }

  void tend(base::Time now) {
    if (adapter_.open() || !retry_.due(now)) return;
    Opened<Descriptor> adapter = open_i2c_adapter(settings_);
    problem_ = adapter ? std::string() : adapter.problem();
    if (adapter) adapter_ = std::move(*adapter);
  }

  [[nodiscard]] bool connected() const { return adapter_.open(); }
  [[nodiscard]] const std::string& problem() const { return problem_; }
  [[nodiscard]] int descriptor() const { return done_.descriptor(); }

 private:
  enum class State : unsigned char { kIdle, kUnderWay, kDone };

  void run() {
    std::unique_lock lock(mutex_);
    for (;;) {
      wake_.wait(lock, [this] { return stop_ || state_ == State::kUnderWay; });
      if (stop_) return;
      lock.unlock();
      const Result<std::size_t> answer = run_i2c_transfer(adapter_.get(), settings_.path, transfer_);
      lock.lock();
      answer_ = answer;
      state_ = State::kDone;
      done_.raise();
    }
  }

  I2cSettings settings_;
  Descriptor adapter_;  ///< used by the thread only during a transfer, changed by the loop only between transfers
  SignalFlag done_;
  Retry retry_;
  std::string problem_;
  std::mutex mutex_;
  std::condition_variable wake_;
  State state_ = State::kIdle;
  bool stop_ = false;
  I2cTransfer transfer_;
  Result<std::size_t> answer_ = Error::kNotReady;
  std::thread thread_;  ///< last, so that it starts when the others are there
};

Opened<I2c> I2c::open(I2cSettings settings) {
  Opened<Descriptor> adapter = open_i2c_adapter(settings);
  if (!adapter) return Problem{adapter.problem()};
  Opened<SignalFlag> done = SignalFlag::open();
  if (!done) return Problem{done.problem()};
  return I2c(std::make_unique<Worker>(std::move(settings), std::move(*adapter), std::move(*done)));
}

I2c::I2c(std::unique_ptr<Worker> worker) : worker_(std::move(worker)) {}
I2c::~I2c() = default;
I2c::I2c(I2c&&) noexcept = default;
I2c& I2c::operator=(I2c&&) noexcept = default;

Result<std::size_t> I2c::begin(std::uint8_t address, std::span<const std::uint8_t> out, std::size_t expected) {
  return worker_->begin(address, out, expected);
}
Result<std::size_t> I2c::finish(std::span<std::uint8_t> in) { return worker_->finish(in); }
void I2c::tend(base::Time now) { worker_->tend(now); }
bool I2c::connected() const { return worker_->connected(); }
const std::string& I2c::problem() const { return worker_->problem(); }
int I2c::descriptor() const { return worker_->descriptor(); }

}  // namespace fencepost::linux
