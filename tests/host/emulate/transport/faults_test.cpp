#include "host/emulate/transport/faults.hpp"

#include <gtest/gtest.h>

#include "host/emulate/transport/line.hpp"

namespace fencepost::emulate {
namespace {

TEST(Faults, AreReadAsWritten) {
  const ParsedFaults parsed =
      parse_faults("drop=0.01,corrupt=0.02,stall=0.001:2.0,reboot=30,late=0.05:0.2,unplug=20:3");
  EXPECT_EQ(parsed.problem, "");
  EXPECT_DOUBLE_EQ(parsed.settings.drop, 0.01);
  EXPECT_DOUBLE_EQ(parsed.settings.corrupt, 0.02);
  EXPECT_DOUBLE_EQ(parsed.settings.stall, 0.001);
  EXPECT_EQ(parsed.settings.stall_time.raw, 20'000);
  EXPECT_EQ(parsed.settings.reboot.raw, 300'000);
  EXPECT_DOUBLE_EQ(parsed.settings.late, 0.05);
  EXPECT_EQ(parsed.settings.late_time.raw, 2'000);
  EXPECT_EQ(parsed.settings.unplug.raw, 200'000);
  EXPECT_EQ(parsed.settings.unplug_time.raw, 30'000);
}

TEST(Faults, SayWhatIsWrong) {
  for (const char* text : {"", "drop", "drop=", "drop=2", "drop=-1", "drop=nan", "drop=0.1:2", "stall=0.1",
                           "stall=0.1:", "reboot=0", "reboot=30x", "unplug=20", "sneeze=1", "drop=0.1,"}) {
    EXPECT_NE(parse_faults(text).problem, "") << text;
  }
  EXPECT_NE(parse_faults("stall=1").problem.find("stall=0.001:2.0"), std::string::npos) << "an example";
}

Bytes numbered(std::size_t count) {
  Bytes bytes;
  for (std::size_t i = 0; i < count; ++i) bytes.push_back(static_cast<std::uint8_t>(i));
  return bytes;
}

// 11,520 bytes a second: the first ten bytes take 868 us, so eight ticks of 0.1 ms bring nine, nine bring ten.
TEST(Line, BringsBytesAtItsBaudRate) {
  Line line({115'200, 1, {}, 1});
  line.say(numbered(100), base::Time{1'000});
  EXPECT_TRUE(line.to_host(base::Time{1'000}).empty());
  EXPECT_EQ(line.to_host(base::Time{1'008}).size(), 9U);
  EXPECT_EQ(line.to_host(base::Time{1'009}), Bytes{9});
  line.say(numbered(1), base::Time{1'009});
  EXPECT_EQ(line.to_host(base::Time{1'087}).size(), 90U) << "behind the others";
  EXPECT_FALSE(line.idle());
  EXPECT_EQ(line.next_to_host(), base::Time{1'088});
  EXPECT_EQ(line.to_host(base::Time{1'088}), Bytes{0});
  EXPECT_TRUE(line.idle());
}

TEST(Line, IsFullUntilMuchOfItHasArrived) {
  Line line({115'200, 1, {}, 1});
  line.say(numbered(65'535), base::Time{0});
  EXPECT_FALSE(line.full());
  line.send(numbered(1), base::Time{0});
  EXPECT_TRUE(line.full()) << "both directions count: what comes in is answered";
  (void)line.to_host(base::Time{10});
  EXPECT_FALSE(line.full());
}

TEST(Line, WithoutBaudIsThereAtOnce) {
  Line line({0, 1, {}, 1});
  line.say(numbered(3), base::Time{5});
  EXPECT_EQ(line.to_host(base::Time{5}), numbered(3));
}

// A binomial of 100,000 draws of 0.01 has a deviation of 31: five of them.
TEST(Line, LosesAndDamagesAsOftenAsAsked) {
  FaultSettings faults;
  faults.drop = 0.01;
  faults.corrupt = 0.02;
  Line line({0, 1, faults, 9});
  std::size_t there = 0;
  std::size_t wrong = 0;
  for (int i = 0; i < 100'000; ++i) {
    const Bytes one = {0x55};
    line.say(one, base::Time{i});
    for (const std::uint8_t byte : line.to_host(base::Time{i})) ++there, wrong += byte == 0x55 ? 0U : 1U;
  }
  EXPECT_NEAR(static_cast<double>(100'000 - there), 1'000, 160);
  EXPECT_NEAR(static_cast<double>(wrong), 1'980, 220);
  EXPECT_EQ(line.counts().bytes, 100'000U);
  EXPECT_EQ(line.counts().dropped, 100'000 - there);
  EXPECT_EQ(line.counts().corrupted, wrong);
}

Bytes carried(std::uint64_t seed, std::size_t portion) {
  FaultSettings faults;
  faults.drop = 0.1;
  faults.corrupt = 0.1;
  Line line({0, 1, faults, seed});
  const Bytes all = numbered(240);
  Bytes arrived;
  for (std::size_t at = 0; at < all.size(); at += portion) {
    line.send(std::span(all).subspan(at, portion), base::Time{});
    for (const std::uint8_t byte : line.to_device(base::Time{})) arrived.push_back(byte);
    line.say(all, base::Time{});  // the other direction's dice are others
  }
  return arrived;
}

TEST(Line, IsTheSameForTheSameSeedHoweverItIsCut) {
  EXPECT_EQ(carried(4, 240), carried(4, 1));
  EXPECT_EQ(carried(4, 240), carried(4, 16));
  EXPECT_NE(carried(4, 240), carried(5, 240));
}

TEST(Line, IsLateAndStalls) {
  FaultSettings faults;
  faults.late = 1;
  faults.late_time = base::milliseconds(200);
  faults.stall = 1;
  faults.stall_time = base::milliseconds(2'000);
  Line line({0, 1, faults, 1});
  line.say(numbered(2), base::Time{});
  EXPECT_TRUE(line.to_host(base::Time{1'999}).empty());
  EXPECT_EQ(line.to_host(base::Time{2'000}).size(), 2U);
  line.send(numbered(1), base::Time{2'100});
  EXPECT_TRUE(line.to_device(base::Time{21'999}).empty()) << "stalled both ways";
  EXPECT_EQ(line.next_to_device(), base::Time{22'000});
  EXPECT_EQ(line.to_device(base::Time{22'000}).size(), 1U);
  EXPECT_EQ(line.counts().late, 1U);
  EXPECT_EQ(line.counts().stalled, 1U);
}

TEST(Line, OfFramesLosesThemWhole) {
  FaultSettings faults;
  faults.drop = 0.1;
  faults.corrupt = 0.1;
  Line line({0, 16, faults, 2});
  for (int i = 0; i < 1'000; ++i) line.say(numbered(16), base::Time{});
  const Bytes arrived = line.to_host(base::Time{});
  EXPECT_EQ(arrived.size() % 16, 0U);
  for (std::size_t i = 0; i < arrived.size(); ++i) ASSERT_EQ(arrived[i], i % 16);
  // 0.9 * 0.9 of them; deviation 12.
  EXPECT_NEAR(static_cast<double>(arrived.size()) / 16, 810, 62);
}

}  // namespace
}  // namespace fencepost::emulate
