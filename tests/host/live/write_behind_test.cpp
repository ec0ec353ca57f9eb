// Nothing here depends on how fast the thread is: the disk is a gate that the test opens.
#include "host/live/write_behind.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "host/live/log_keeper.hpp"
#include "tests/host/live/gate_sink.hpp"

namespace fencepost::host {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kAnyTime{60'000};
constexpr base::Time at(double seconds) { return base::Time::nearest(seconds); }

class WriteBehindTest : public testing::Test {
 protected:
  /// Has taken "first\n", and stands.
  WriteBehindTest() {
    EXPECT_EQ(log.put("first\n", at(0)), 6U);
    gate->await_writer();
  }
  ~WriteBehindTest() override { gate->open(); }

  std::shared_ptr<Gate> gate = std::make_shared<Gate>();
  WriteBehind log{std::make_unique<GateSink>(gate), 100};
};

TEST_F(WriteBehindTest, TakesWholeLinesAsLongAsThereIsRoom) {
  const std::string line = std::string(29, 'x') + "\n";
  EXPECT_EQ(log.put(line + line + line + line, at(0)), 90U) << "94 bytes are left";
  EXPECT_EQ(log.waiting(), 96U);
  EXPECT_EQ(log.put("12345\n", at(0)), 0U);
  EXPECT_EQ(log.put("123\n567\n", at(0)), 4U);
  EXPECT_EQ(log.waiting(), 100U);
  EXPECT_EQ(gate->written(), "");
  gate->open();
  ASSERT_TRUE(log.close(kAnyTime));
  EXPECT_EQ(gate->written(), "first\n" + line + line + line + "123\n");
  EXPECT_TRUE(gate->closed());
  EXPECT_EQ(log.bytes(), 100U);
  EXPECT_EQ(log.lost(), 0U);
}

// Each write of some disks takes a tenth of a second, whatever its size.
TEST_F(WriteBehindTest, WritesAllThatWaitsAtOnce) {
  for (int i = 0; i < 20; ++i) EXPECT_EQ(log.put("x\n", at(0)), 2U);
  gate->open();
  ASSERT_TRUE(log.close(kAnyTime));
  EXPECT_EQ(gate->writes(), 2);
}

TEST_F(WriteBehindTest, AfterAFaultNothingIsTakenAndAllIsCounted) {
  EXPECT_EQ(log.put("second\n", at(0)), 7U);
  gate->fail("the disk is full");
  gate->open();
  ASSERT_TRUE(log.close(kAnyTime));
  ASSERT_TRUE(log.fault());
  EXPECT_EQ(log.fault()->sentence, "the disk is full");
  EXPECT_EQ(log.lost(), 13U);
  EXPECT_EQ(log.waiting(), 0U);
  EXPECT_EQ(log.put("third\n", at(1)), 0U);
  EXPECT_EQ(gate->written(), "");
}

TEST_F(WriteBehindTest, ADiskThatStandsStillIsNotWaitedForAtTheEnd) {
  EXPECT_FALSE(log.close(milliseconds(1)));
  EXPECT_EQ(log.waiting(), 6U);
  gate->open();
  EXPECT_TRUE(log.close(kAnyTime)) << "it may be asked again";
  EXPECT_EQ(gate->written(), "first\n");
}

TEST_F(WriteBehindTest, KnowsForHowLongNothingWasWritten) {
  EXPECT_EQ(log.stalled(at(3)), base::milliseconds(3'000));
  gate->open(1);
  while (log.waiting() > 0) std::this_thread::yield();
  EXPECT_EQ(log.stalled(at(4)), base::Duration{}) << "nothing waits";
  EXPECT_EQ(log.put("second\n", at(9)), 7U);
  EXPECT_EQ(log.stalled(at(10)), base::milliseconds(6'000));
}

class LogKeeperTest : public WriteBehindTest {
 protected:
  [[nodiscard]] bool said(const std::string& part) const { return heard.find(part) != std::string::npos; }

  std::string heard;
  LogKeeper keeper{&log, [this](std::string_view text) { heard += std::string(text) + "\n"; }, "; it goes on", at(0)};
  const std::string line = std::string(49, 'x') + "\n";
};

TEST_F(LogKeeperTest, ASlowDiskIsNamedAndCostsNothingWhileThereIsRoom) {
  EXPECT_EQ(keeper.take(line, at(1)), 50U);
  EXPECT_EQ(heard, "");
  EXPECT_EQ(keeper.take("", at(2)), 0U);
  EXPECT_EQ(heard, "the disk of the log gate.log has taken nothing for 2 s; what is logged waits in memory\n");
  EXPECT_EQ(keeper.take("", at(60)), 0U);
  EXPECT_TRUE(keeper.works()) << "as long as it fits";
  gate->open();
  keeper.close(at(61));
  EXPECT_TRUE(keeper.works());
  EXPECT_EQ(gate->written(), "first\n" + line);
  EXPECT_EQ(keeper.lost(), 0U);
}

// Lines that are not taken stay with the loop, which then refuses its inputs.
TEST_F(LogKeeperTest, AFullQueueTakesNothingAndSaysSo) {
  EXPECT_EQ(keeper.take(line + line, at(1)), 50U);
  EXPECT_TRUE(keeper.behind());
  EXPECT_TRUE(said("the disk of the log gate.log is too slow")) << heard;
  gate->open();
  while (log.waiting() > 0) std::this_thread::yield();
  EXPECT_EQ(keeper.take(line, at(2)), 50U);
  EXPECT_FALSE(keeper.behind());
  keeper.close(at(3));
  EXPECT_EQ(gate->written(), "first\n" + line + line) << "all that was taken, in order, and nothing else";
}

TEST_F(LogKeeperTest, ADiskThatStaysAwayEndsTheLogAndNotTheRun) {
  EXPECT_EQ(keeper.take(line + line, at(1)), 50U);
  EXPECT_EQ(keeper.take(line, at(9.9)), 0U);
  EXPECT_TRUE(keeper.works());
  EXPECT_EQ(keeper.take(line, at(10)), 50U) << "dealt with: there is no log any more";
  EXPECT_TRUE(keeper.failed());
  EXPECT_FALSE(keeper.behind());
  EXPECT_TRUE(said("gate.log has taken nothing for 10 s; look at the end of 'dmesg', or choose another; it goes on"))
      << heard;
  EXPECT_EQ(keeper.take(line, at(11)), 50U);
  EXPECT_EQ(keeper.until(), base::milliseconds(10'000));
  EXPECT_EQ(keeper.lost(), 50U + 50U + 56U) << "two that came later, and what waits";
}

TEST_F(LogKeeperTest, AFaultIsSaidOnceWithWhatIsLostFromThen) {
  gate->fail("the disk is full");
  gate->open();
  while (!log.fault()) std::this_thread::yield();
  for (const double t : {1.0, 2.0, 3.0}) EXPECT_EQ(keeper.take(line, at(t)), 50U);
  EXPECT_EQ(heard, "the disk is full; it goes on\n");
  EXPECT_EQ(keeper.until(), base::milliseconds(1'000));
  EXPECT_EQ(keeper.lost(), 156U);
}

TEST(LogKeeper, WithoutALogAllIsDealtWith) {
  LogKeeper keeper(
      nullptr, [](std::string_view) { ADD_FAILURE(); }, "", at(0));
  EXPECT_EQ(keeper.take("line\n", at(0)), 5U);
  keeper.close(at(1));
  EXPECT_FALSE(keeper.works());
  EXPECT_FALSE(keeper.failed());
  EXPECT_EQ(keeper.lost(), 0U);
}

}  // namespace
}  // namespace fencepost::host
