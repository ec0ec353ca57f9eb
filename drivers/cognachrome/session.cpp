#include "drivers/cognachrome/session.hpp"

#include <algorithm>

namespace fencepost::cognachrome {
namespace {

constexpr base::Duration kPatience = base::milliseconds(500);
// Maximum gap between two frames that count: six fields. A frame has no checksum, so noise may look like one, but
// hardly twice in a row.
constexpr base::Duration kSteady = base::milliseconds(100);
// Maximum wait for a prompt.
constexpr base::Duration kPrompt = base::milliseconds(300);
constexpr std::array<std::uint8_t, 2> kToVision = {0xFE, 3};  // stream 3 is tpuvis

/// The prompt with which tpuvis asks for a string, and the keys that bring it up.
struct Question {
  std::string_view prompt;
  std::string_view keys;
};
constexpr std::array<Question, 1 + kChannels> kQuestions = {
    {{"header:", "ph"}, {"chan A:", "pa"}, {"chan B:", "pb"}, {"chan C:", "pc"}}};

}  // namespace

bool Session::take(std::uint8_t byte, base::Time now) {
  byte_at_ = now;
  const bool complete = decoder_.feed(byte, now);
  if (complete) {
    steady_ = frame_at_ && now - *frame_at_ <= kSteady;
    frame_at_ = now;
  }
  follow_prompt(byte, now);
  return complete && steady_;
}

void Session::follow_prompt(std::uint8_t byte, base::Time now) {
  std::copy(tail_.begin() + 1, tail_.end(), tail_.begin());
  tail_.back() = static_cast<char>(byte);
  if (asked_ == 0 || std::string_view(tail_.data(), kTail) != kQuestions[asked_ - 1U].prompt) return;
  const std::string_view text = format_.strings[asked_ - 1U];
  if (asked_ == kQuestions.size()) {
    say(text, "r", now);
    return listen(now);
  }
  say(text, kQuestions[asked_].keys, now);
  ++asked_;
}

// A string ends with a line feed; keys do not.
void Session::say(std::string_view first, std::string_view then, base::Time now) {
  outbox_.clear();
  (void)outbox_.put(kToVision);
  (void)outbox_.put(first);
  if (!first.empty()) (void)outbox_.put("\n");
  (void)outbox_.put(then);
  deadline_ = now + kPrompt;
}

void Session::listen(base::Time now) {
  asked_ = 0;
  deadline_ = now + kPatience;
}

void Session::step(base::Time now) {
  if (byte_at_ && now - *byte_at_ > kPatience) byte_at_.reset();
  if (frame_at_ && now - *frame_at_ > kPatience) frame_at_.reset();
  // While it is asked a frame may be one that was begun before and ended by a prompt's letters.
  if (!deadline_ || (frame_at_ && asked_ == 0)) return listen(now);
  if (now < *deadline_ || format_.strings[0].empty()) return;
  if (frame_at_) return listen(now);
  // The line stalls: the last keys have not been sent yet.
  if (asked_ > 0 && !outbox_.waiting().empty()) {
    deadline_ = now + kPrompt;
    return;
  }
  // The line feed ends what an earlier try left open.
  say({}, "\nq", now);
  (void)outbox_.put(kQuestions[0].keys);
  decoder_.reset();
  asked_ = 1;
}

void Session::link_lost() {
  decoder_.reset();
  outbox_.clear();
  asked_ = 0;
  byte_at_.reset();
  frame_at_.reset();
  deadline_.reset();
}

sensor::LinkState Session::link() const {
  using enum sensor::LinkState;
  if (!byte_at_) return kSilent;
  if (!frame_at_ || !steady_) return kUnready;
  return decoder_.saw() ? kOk : kEmpty;
}

}  // namespace fencepost::cognachrome
