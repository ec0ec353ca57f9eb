// A disk that stands still until the test lets it go on.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>

#include "host/live/write_behind.hpp"

namespace fencepost::host {

/// Shared by the test and the sink.
class Gate {
 public:
  /// Lets `calls` more through.
  void open(int calls = 1'000'000) {
    const std::lock_guard lock(mutex_);
    allowed_ += calls;
    changed_.notify_all();
  }
  /// From here on writing fails.
  void fail(const std::string& sentence) {
    const std::lock_guard lock(mutex_);
    fault_ = sentence;
  }
  /// Waits until the thread stands before the closed gate.
  void await_writer() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return standing_; });
  }
  [[nodiscard]] std::string written() const {
    const std::lock_guard lock(mutex_);
    return written_;
  }
  [[nodiscard]] int writes() const {
    const std::lock_guard lock(mutex_);
    return writes_;
  }
  [[nodiscard]] bool closed() const {
    const std::lock_guard lock(mutex_);
    return closed_;
  }

 private:
  friend class GateSink;

  void pass(std::unique_lock<std::mutex>& lock) {
    standing_ = allowed_ == 0;
    changed_.notify_all();
    changed_.wait(lock, [this] { return allowed_ > 0; });
    standing_ = false;
    --allowed_;
  }

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  int allowed_ = 0;
  bool standing_ = false;
  bool closed_ = false;
  int writes_ = 0;
  std::string written_;
  std::string fault_;
};

class GateSink final : public Sink {
 public:
  explicit GateSink(std::shared_ptr<Gate> gate) : gate_(std::move(gate)) {}
  Fault write(std::string_view lines, base::Time /*now*/) override {
    std::unique_lock lock(gate_->mutex_);
    gate_->pass(lock);
    if (!gate_->fault_.empty()) return linux::Problem{gate_->fault_};
    ++gate_->writes_;
    gate_->written_ += lines;
    return std::nullopt;
  }
  Fault tend(base::Time /*now*/) override { return std::nullopt; }
  Fault close() override {
    std::unique_lock lock(gate_->mutex_);
    gate_->pass(lock);
    gate_->closed_ = true;
    return std::nullopt;
  }
  [[nodiscard]] std::string name() const override { return "gate.log"; }
  [[nodiscard]] std::uint64_t bytes() const override {
    const std::lock_guard lock(gate_->mutex_);
    return gate_->written_.size();
  }

 private:
  std::shared_ptr<Gate> gate_;
};

}  // namespace fencepost::host
