// Schedules the requests of several clients and matches replies to them. Independent of the bus.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "drivers/nxt/telegram.hpp"
#include "hal/base/fixed.hpp"
#include "hal/base/units.hpp"
#include "hal/sensor/link_state.hpp"

namespace fencepost::nxt {

/// One request and its outcome; owned by the client, which must not move it while it is pending.
struct Exchange {
  enum class State : std::uint8_t { kIdle, kWaiting, kDone, kFailed };
  State state = State::kIdle;
  Telegram request;
  Telegram answer;  ///< of kDone: a reply, whatever its status
  base::Time t;     ///< of kDone: when it arrived

  [[nodiscard]] bool under_way() const { return state == State::kWaiting; }
  /// Of kDone.
  [[nodiscard]] Reply reply() const { return *reply_in(answer.view()); }
};

struct Counters {
  std::uint32_t telegrams = 0;  ///< replies taken
  std::uint32_t unmatched = 0;  ///< replies to no pending request, late ones of an earlier try included
  std::uint32_t malformed = 0;  ///< messages that are no replies
  std::uint32_t timeouts = 0;
  std::uint32_t failed = 0;  ///< exchanges given up
};

/// One request is outstanding at a time; the brick replies in order. A missing reply may be late or lost, and replies
/// do not name the request that they answer. So the version is requested as a fence before a request is repeated or
/// another sent: after its reply nothing older can arrive. After three tries of a request and three of the version the
/// link is silent. Then all pending requests fail, and the version is requested five times a second. Also keeps the
/// brick awake and reads its battery.
class Conversation {
 public:
  static constexpr std::size_t kAskers = 6;

  /// False, and nothing done, when full. `exchange.request` is set; a failed one may be submitted again.
  bool submit(Exchange& exchange);

  /// The next telegram to send, if any; it counts as sent.
  std::optional<Telegram> due(base::Time now);
  void take(std::span<const std::uint8_t> telegram, base::Time now);
  /// Unplugged: everything fails.
  void lose_link(base::Time now);
  void find_link() { absent_ = false; }

  [[nodiscard]] sensor::LinkState link() const;
  /// Of the last `due`.
  [[nodiscard]] base::Time now() const { return now_; }
  [[nodiscard]] const Counters& counters() const { return counters_; }
  [[nodiscard]] const std::optional<Version>& version() const { return version_; }
  [[nodiscard]] std::optional<std::uint16_t> battery_millivolts() const { return battery_; }
  /// Incremented each time the brick answers again after silence: it may have restarted.
  [[nodiscard]] std::uint32_t sessions() const { return sessions_; }

 private:
  enum class Phase : std::uint8_t { kIdle, kAsked, kFenced, kSilent };

  void keep_house(base::Time now);
  void expire(base::Time now);
  std::optional<Telegram> ask_front(base::Time now);
  Telegram send_fence(Phase phase, base::Time now);
  void pass_fence(const Reply& reply);
  void close_front(Exchange::State state);
  void fail_all();

  base::FixedVector<Exchange*, kAskers + 2> waiting_;
  Exchange battery_exchange_;
  Exchange keep_alive_exchange_;
  Phase phase_ = Phase::kSilent;
  bool absent_ = false;
  bool fence_due_ = true;
  std::uint8_t tries_ = 0;  ///< of the front request
  std::uint8_t fences_ = 0;
  base::Time now_;
  std::optional<base::Time> deadline_;
  std::optional<base::Time> housekeeping_;  ///< when the keep-alive and the battery are next
  std::optional<Version> version_;
  std::optional<std::uint16_t> battery_;
  std::uint32_t sessions_ = 0;
  Counters counters_;
};

}  // namespace fencepost::nxt
