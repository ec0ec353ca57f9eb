#include "drivers/nxt/conversation.hpp"

namespace fencepost::nxt {
namespace {

// Bluetooth replies within some 30 ms, later while the brick is busy with its display.
constexpr base::Duration kReplyTime = base::milliseconds(200);
// Interval of the requests to a silent brick.
constexpr base::Duration kProbePause = base::milliseconds(200);
// Interval of keep-alives and battery readings. The shortest idle time that the brick can be set to is two minutes.
constexpr base::Duration kHousePause = base::milliseconds(5'000);
// Tries of a request, and of the fence after it.
constexpr std::uint8_t kTries = 3;

}  // namespace

bool Conversation::submit(Exchange& exchange) {
  if (exchange.under_way() || !waiting_.push_back(&exchange)) return false;
  exchange.state = Exchange::State::kWaiting;
  return true;
}

void Conversation::keep_house(base::Time now) {
  if (phase_ == Phase::kSilent || (housekeeping_ && now < *housekeeping_)) return;
  housekeeping_ = now + kHousePause;
  keep_alive_exchange_.request = keep_alive();
  battery_exchange_.request = get_battery();
  (void)submit(keep_alive_exchange_);
  (void)submit(battery_exchange_);
}

std::optional<Telegram> Conversation::due(base::Time now) {
  now_ = now;
  keep_house(now);
  if (deadline_ && now >= *deadline_) expire(now);
  if (deadline_) return std::nullopt;
  if (phase_ == Phase::kSilent) return send_fence(Phase::kSilent, now);
  if (fence_due_) return send_fence(Phase::kFenced, now);
  return ask_front(now);
}

std::optional<Telegram> Conversation::ask_front(base::Time now) {
  if (waiting_.empty()) return std::nullopt;
  phase_ = Phase::kAsked;
  deadline_ = now + kReplyTime;
  ++tries_;
  return waiting_[0]->request;
}

Telegram Conversation::send_fence(Phase phase, base::Time now) {
  phase_ = phase;
  deadline_ = now + (phase == Phase::kSilent ? kProbePause : kReplyTime);
  return get_version();
}

void Conversation::expire(base::Time now) {
  ++counters_.timeouts;
  deadline_.reset();
  if (phase_ == Phase::kAsked) {
    fence_due_ = true;
    fences_ = 0;
  } else if (phase_ == Phase::kSilent) {
    fail_all();
  } else if (++fences_ == kTries) {
    fail_all();
    phase_ = Phase::kSilent;
    deadline_ = now + kProbePause;
  }
}

void Conversation::take(std::span<const std::uint8_t> telegram, base::Time now) {
  const std::optional<Reply> reply = reply_in(telegram);
  if (!reply) {
    ++counters_.malformed;
    return;
  }
  ++counters_.telegrams;
  const bool open = !waiting_.empty() && tries_ > 0;
  if (open && answers(*reply, waiting_[0]->request)) {
    Exchange& front = *waiting_[0];
    front.answer.clear();
    for (const std::uint8_t byte : telegram) (void)front.answer.push_back(byte);
    front.t = now;
    close_front(Exchange::State::kDone);
    // Late, it leaves the fence still to come.
    if (phase_ == Phase::kAsked) deadline_.reset(), phase_ = Phase::kIdle;
  } else if (reply->opcode == Opcode::kGetVersion && (phase_ == Phase::kFenced || phase_ == Phase::kSilent)) {
    pass_fence(*reply);
  } else {
    ++counters_.unmatched;
  }
}

void Conversation::pass_fence(const Reply& reply) {
  if (reply.status == status::kOk) version_ = version_of(reply);
  if (phase_ == Phase::kSilent) ++sessions_;
  phase_ = Phase::kIdle;
  fence_due_ = false;
  deadline_.reset();
  if (tries_ == kTries) {
    ++counters_.failed;
    close_front(Exchange::State::kFailed);
  }
}

void Conversation::close_front(Exchange::State state) {
  Exchange& front = *waiting_[0];
  waiting_.erase_at(0);
  tries_ = 0;
  front.state = state;
  if (state != Exchange::State::kDone || &front != &battery_exchange_) return;
  const Reply reply = front.reply();
  if (reply.status == status::kOk) battery_ = battery_millivolts_of(reply);
}

void Conversation::fail_all() {
  while (!waiting_.empty()) {
    ++counters_.failed;
    close_front(Exchange::State::kFailed);
  }
}

void Conversation::lose_link(base::Time now) {
  absent_ = true;
  fail_all();
  phase_ = Phase::kSilent;
  deadline_ = now + kProbePause;
}

sensor::LinkState Conversation::link() const {
  if (absent_) return sensor::LinkState::kAbsent;
  return phase_ == Phase::kSilent ? sensor::LinkState::kSilent : sensor::LinkState::kOk;
}

}  // namespace fencepost::nxt
