// One browser's connection: a request, then the page or the log.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "hal/linux/descriptor.hpp"
#include "host/view/growing_log.hpp"

namespace fencepost::host {

/// Nothing here waits.
class Visitor {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// `page` and `log` are borrowed; `fd` does not block. Not `served`: whatever it asks for, there are too many.
  Visitor(linux::Descriptor fd, std::string_view page, const GrowingLog& log, Time now, bool served)
      : fd_(std::move(fd)), page_(page), log_(&log), served_(served), moved_(now) {}

  /// Reads and writes what can be without waiting.
  void serve(Time now);
  /// It has gone, has all that it asked for, or is too slow.
  [[nodiscard]] bool over() const { return !fd_.open(); }
  /// Nobody has asked for anything yet: browsers connect ahead of time.
  [[nodiscard]] bool idle() const { return state_ == State::kAsking; }

  [[nodiscard]] bool served() const { return served_; }
  [[nodiscard]] int descriptor() const { return fd_.get(); }
  /// There is something to write that the other end does not take now.
  [[nodiscard]] bool waits_to_write() const { return sent_ < out_.size(); }
  [[nodiscard]] bool follows_log() const { return state_ == State::kFollowing; }

  static constexpr std::chrono::seconds kAskTime{5};     ///< for the whole request
  static constexpr std::chrono::seconds kStuckTime{30};  ///< maximum time without taking a byte of the waiting answer
  static constexpr std::chrono::seconds kLeaveTime{2};   ///< to hang up after the last byte

 private:
  enum class State { kAsking, kGiven, kFollowing, kLeaving };

  void receive(Time now);
  void answer(std::string_view head);
  void refuse(int status, std::string_view because);
  void refill();
  void send(Time now);
  [[nodiscard]] bool too_slow(Time now) const;

  linux::Descriptor fd_;
  std::string_view page_;
  const GrowingLog* log_;
  bool served_;
  State state_ = State::kAsking;
  std::string asked_;
  std::string out_;
  std::size_t sent_ = 0;
  std::uint64_t place_ = 0;  ///< in the log
  Time moved_;               ///< when it came, or last took something
};

}  // namespace fencepost::host
