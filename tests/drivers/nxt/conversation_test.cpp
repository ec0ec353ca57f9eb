// Replies that are late, lost, unmatched; requests that wait for each other.
#include "drivers/nxt/conversation.hpp"

#include <gtest/gtest.h>

#include "tests/drivers/hex.hpp"

namespace fencepost::nxt {
namespace {

using sensor::LinkState;
using test::bytes_of;
using test::hex;
using State = Exchange::State;

const std::vector<std::uint8_t> kVersionReply = hex("02 88 00 7C 01 1D 01");
const std::vector<std::uint8_t> kAliveReply = hex("02 0D 00 C0 27 09 00");
const std::vector<std::uint8_t> kBatteryReply = hex("02 0B 00 78 1E");
const std::vector<std::uint8_t> kStatusReply = hex("02 0E 00 05");
const std::vector<std::uint8_t> kWriteReply = hex("02 0F 00");

struct TalkBench {
  Conversation conversation;
  base::Time now{};
  Exchange exchange;

  // The next telegram that is sent within a second.
  std::vector<std::uint8_t> next() {
    for (int ms = 0; ms < 1'000; ++ms) {
      if (const auto telegram = conversation.due(now)) return bytes_of(*telegram);
      now = now + base::milliseconds(1);
    }
    return {};
  }
  void reply(const std::vector<std::uint8_t>& bytes) { conversation.take(bytes, now); }
  // Version, keep-alive and battery done.
  void greet() {
    EXPECT_EQ(next(), hex("01 88"));
    reply(kVersionReply);
    EXPECT_EQ(next(), hex("00 0D"));
    reply(kAliveReply);
    EXPECT_EQ(next(), hex("00 0B"));
    reply(kBatteryReply);
  }
  bool ask(const Telegram& request) {
    exchange.request = request;
    return conversation.submit(exchange);
  }
};

struct NxtConversation : testing::Test {
  NxtConversation() { bench.greet(); }
  TalkBench bench;
};

TEST_F(NxtConversation, GreetsKeepsAwakeAndReadsTheBattery) {
  EXPECT_EQ(TalkBench().conversation.link(), LinkState::kSilent);
  EXPECT_EQ(bench.conversation.link(), LinkState::kOk);
  EXPECT_EQ(bench.conversation.version(), (Version{1, 124, 1, 29}));
  EXPECT_EQ(bench.conversation.battery_millivolts(), 7800);
  EXPECT_EQ(bench.conversation.sessions(), 1U);
  const base::Time before = bench.now;
  bench.now = before + base::milliseconds(4'500);
  EXPECT_EQ(bench.next(), hex("00 0D"));
  EXPECT_EQ(bench.now - before, base::milliseconds(5'000));
}

TEST_F(NxtConversation, OneRequestIsOutstanding) {
  Exchange other;
  other.request = sensor_status(1);
  EXPECT_TRUE(bench.ask(sensor_status(0)));
  EXPECT_FALSE(bench.conversation.submit(bench.exchange));  // under way
  EXPECT_TRUE(bench.conversation.submit(other));
  EXPECT_EQ(bench.next(), hex("00 0E 00"));
  EXPECT_FALSE(bench.conversation.due(bench.now));
  bench.reply(kStatusReply);
  EXPECT_EQ(bench.exchange.state, State::kDone);
  EXPECT_EQ(bench.exchange.t, bench.now);
  EXPECT_EQ(ready_bytes_of(bench.exchange.reply()), 5);
  EXPECT_EQ(other.state, State::kWaiting);
  EXPECT_EQ(bench.next(), hex("00 0E 01"));
}

TEST_F(NxtConversation, ForeignAndMalformedRepliesAreCounted) {
  EXPECT_TRUE(bench.ask(sensor_status(0)));
  EXPECT_EQ(bench.next(), hex("00 0E 00"));
  bench.reply(kWriteReply);
  bench.reply(kVersionReply);
  bench.reply(hex("02 0E"));
  EXPECT_EQ(bench.conversation.counters().unmatched, 2U);
  EXPECT_EQ(bench.conversation.counters().malformed, 1U);
  EXPECT_EQ(bench.exchange.state, State::kWaiting);
  bench.reply(kStatusReply);
  EXPECT_EQ(bench.exchange.state, State::kDone);
  bench.reply(kStatusReply);
  EXPECT_EQ(bench.conversation.counters().unmatched, 3U);
}

TEST_F(NxtConversation, ALateReplyIsTakenAndCannotAnswerTheNext) {
  EXPECT_TRUE(bench.ask(sensor_status(0)));
  EXPECT_EQ(bench.next(), hex("00 0E 00"));
  EXPECT_EQ(bench.next(), hex("01 88"));  // timed out: the fence
  bench.reply(hex("02 0E 00 05"));        // late, but before the fence's
  EXPECT_EQ(bench.exchange.state, State::kDone);
  EXPECT_TRUE(bench.ask(sensor_status(1)));
  EXPECT_FALSE(bench.conversation.due(bench.now));  // the fence first
  bench.reply(kVersionReply);
  EXPECT_EQ(bench.next(), hex("00 0E 01"));
}

TEST_F(NxtConversation, ALostReplyIsAskedForAgainThreeTimes) {
  EXPECT_TRUE(bench.ask(sensor_status(0)));
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(bench.exchange.state, State::kWaiting);
    EXPECT_EQ(bench.next(), hex("00 0E 00"));
    EXPECT_EQ(bench.next(), hex("01 88"));
    bench.reply(kVersionReply);
  }
  EXPECT_EQ(bench.exchange.state, State::kFailed);
  EXPECT_EQ(bench.conversation.counters().failed, 1U);
  EXPECT_EQ(bench.conversation.link(), LinkState::kOk);
}

TEST_F(NxtConversation, SilenceFailsEverybodyAndEnds) {
  EXPECT_TRUE(bench.ask(sensor_status(0)));
  EXPECT_EQ(bench.next(), hex("00 0E 00"));
  for (int i = 0; i < 3; ++i) EXPECT_EQ(bench.next(), hex("01 88"));
  EXPECT_EQ(bench.next(), hex("01 88"));
  EXPECT_EQ(bench.conversation.link(), LinkState::kSilent);
  EXPECT_EQ(bench.exchange.state, State::kFailed);
  // Asked in silence: fails at the next miss, and does not wait indefinitely.
  EXPECT_TRUE(bench.ask(sensor_status(0)));
  EXPECT_EQ(bench.next(), hex("01 88"));
  EXPECT_EQ(bench.exchange.state, State::kFailed);
  // An old reply answers nobody.
  bench.reply(kStatusReply);
  bench.reply(kVersionReply);
  EXPECT_EQ(bench.conversation.link(), LinkState::kOk);
  EXPECT_EQ(bench.conversation.sessions(), 2U);
}

// Before it was asked: it answers somebody else.
TEST_F(NxtConversation, AReplyToWhatWasNotAskedYetIsUnmatched) {
  bench.exchange.request = keep_alive();
  ASSERT_TRUE(bench.conversation.submit(bench.exchange));
  const std::uint32_t before = bench.conversation.counters().unmatched;
  bench.reply(kAliveReply);
  EXPECT_EQ(bench.exchange.state, State::kWaiting);
  EXPECT_EQ(bench.conversation.counters().unmatched, before + 1);
  EXPECT_EQ(bench.next(), hex("00 0D"));
  bench.reply(kAliveReply);
  EXPECT_EQ(bench.exchange.state, State::kDone);
}

}  // namespace
}  // namespace fencepost::nxt
