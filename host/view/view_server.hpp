// `fencepost run --view`: the page and the run's log for browsers of this machine.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "hal/linux/descriptor.hpp"
#include "hal/linux/opened.hpp"
#include "hal/linux/signal_flag.hpp"
#include "host/view/growing_log.hpp"
#include "host/view/visitor.hpp"

namespace fencepost::host {

/// Listens on 127.0.0.1 alone and serves with a thread of its own.
class ViewServer {
 public:
  using Opened = linux::Opened<std::unique_ptr<ViewServer>>;

  /// `page`: the answer to /; port 0: any that is free. errors: a sentence: the port is taken
  static Opened open(std::string page, std::uint16_t port, std::size_t capacity = GrowingLog::kCapacity);
  /// Hangs up on everybody; see `finish`.
  ~ViewServer();
  ViewServer(const ViewServer&) = delete;
  ViewServer& operator=(const ViewServer&) = delete;

  /// Whole lines of the log. Never waits for anybody.
  void add(std::string_view lines) { log_.add(lines); }
  /// The run is over: gives browsers the rest, for at most `patience`.
  void finish(std::chrono::milliseconds patience);
  /// "http://127.0.0.1:4321/".
  [[nodiscard]] std::string address() const;

  static constexpr std::size_t kMaxVisitors = 16;
  /// Beyond them: their request is read, so that they get the answer that there are too many. Then none is heard.
  static constexpr std::size_t kMaxTurnedAway = 16;

 private:
  ViewServer(std::string page, linux::Descriptor listener, std::uint16_t port, linux::SignalFlag stop,
             std::size_t capacity);
  void run();
  void wait();
  void welcome(Visitor::Time now);
  void stop(std::chrono::milliseconds patience);

  const std::string page_;
  const linux::Descriptor listener_;
  const std::uint16_t port_;
  linux::SignalFlag stop_;  ///< raised: `leave_by_` holds
  std::atomic<Visitor::Time> leave_by_{};
  GrowingLog log_;
  std::vector<Visitor> visitors_;  ///< the thread's alone
  bool leaving_ = false;           ///< the thread's alone
  std::thread thread_;
};

}  // namespace fencepost::host
