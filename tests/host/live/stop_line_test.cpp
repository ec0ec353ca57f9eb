// The line that holds the motors, with a line of the test's own in a real process.
#include "host/live/stop_line.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <thread>

namespace fencepost::host {
namespace {

using Clock = std::chrono::steady_clock;
using Ms = std::chrono::milliseconds;

/// The line as the process that has it sets it, seen from here.
struct Level {
  std::atomic<int> high{-1};
  std::atomic<int> sets{0};
  std::atomic<int> error{0};
};

class SharedLevel {
 public:
  SharedLevel()
      : level_(new (::mmap(nullptr, sizeof(Level), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)) Level) {}
  ~SharedLevel() { ::munmap(level_, sizeof(Level)); }
  SharedLevel(const SharedLevel&) = delete;
  SharedLevel& operator=(const SharedLevel&) = delete;
  Level* operator->() const { return level_; }
  Level& operator*() const { return *level_; }

 private:
  Level* level_;
};

class FakeLine final : public linux::OutputLine {
 public:
  explicit FakeLine(Level& level) : level_(level) {}
  int set(bool high) override {
    ++level_.sets;
    if (level_.error != 0) return level_.error;
    level_.high = high ? 1 : 0;
    return 0;
  }

 private:
  Level& level_;
};

AlertNow may(bool move) {
  AlertNow alert;
  alert.may_move = move;
  return alert;
}

class StopLineTest : public ::testing::Test {
 protected:
  std::unique_ptr<StopLine> hold(bool active_high = false) {
    auto line = StopLine::hold(std::make_unique<FakeLine>(*level), active_high, "fake:3");
    EXPECT_TRUE(line.ok());
    return std::move(*line);
  }
  /// How long until it is so; a failure after a second and a half.
  Ms until(const std::function<bool()>& is_so) const {
    const auto begun = Clock::now();
    while (!is_so()) {
      const auto passed = std::chrono::duration_cast<Ms>(Clock::now() - begun);
      if (passed > Ms(1'500)) {
        ADD_FAILURE() << "never";
        return passed;
      }
      std::this_thread::sleep_for(Ms(1));
    }
    return std::chrono::duration_cast<Ms>(Clock::now() - begun);
  }
  Ms until_level(int high) const {
    return until([&] { return level->high == high; });
  }
  /// As a loop does, for so long.
  void show(StopLine& line, bool move, int ms) {
    for (int i = 0; i < ms; i += 5) {
      line.show(may(move), now = now + base::milliseconds(5));
      std::this_thread::sleep_for(Ms(5));
    }
  }

  SharedLevel level;
  base::Time now;
};

TEST_F(StopLineTest, HighOnlyWhileTheRobotMayDrive) {
  const auto line = hold();
  until_level(0);
  show(*line, false, 100);
  EXPECT_EQ(level->high, 0);
  show(*line, true, 600);
  EXPECT_EQ(level->high, 1) << "held as long as it is renewed";
  line->show(may(false), now);
  EXPECT_LE(until_level(0).count(), 20);
  EXPECT_TRUE(line->messages().empty());
}

TEST_F(StopLineTest, ActiveHighIsTheOtherWayRound) {
  const auto line = hold(true);
  until_level(1);
  show(*line, true, 100);
  EXPECT_EQ(level->high, 0);
  line->end(now);
  EXPECT_EQ(level->high, 1);
}

TEST_F(StopLineTest, ALoopThatHangsLosesIt) {
  const auto line = hold();
  show(*line, true, 60);
  EXPECT_EQ(level->high, 1);
  const auto took = until_level(0);
  EXPECT_GE(took.count(), 100);
  EXPECT_LE(took.count(), 400);
  show(*line, true, 60);
  EXPECT_EQ(level->high, 1) << "it hung, and goes on";
}

TEST_F(StopLineTest, TheEndOfTheRunHoldsTheMotors) {
  auto line = hold();
  show(*line, true, 60);
  EXPECT_EQ(level->high, 1);
  line.reset();
  EXPECT_EQ(level->high, 0) << "before it returns";
}

// Not even a program that is killed leaves it released.
TEST_F(StopLineTest, AProgramThatIsKilledHoldsTheMotors) {
  const pid_t program = ::fork();
  if (program == 0) {
    const auto line = hold();
    while (true) show(*line, true, 1'000);
  }
  until_level(1);
  ASSERT_EQ(::kill(program, SIGKILL), 0);
  EXPECT_LE(until_level(0).count(), 50);
  ::waitpid(program, nullptr, 0);
}

TEST_F(StopLineTest, SaysOnceThatTheLineCannotBeSet) {
  const auto line = hold();
  show(*line, true, 60);
  level->error = EIO;
  std::vector<std::string> said;
  for (int i = 0; i < 50; ++i) {
    show(*line, false, 5);
    for (const std::string& sentence : line->messages()) said.push_back(sentence);
  }
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0], "the STOP line fake:3 does not follow any more: Input/output error");
  EXPECT_GE(level->sets, 4) << "it is tried again";
  level->error = 0;
  show(*line, false, 100);
  EXPECT_EQ(level->high, 0);
}

TEST(StopLineSpec, ReadsWhatTheCommandLineSays) {
  const auto plain = parse_stop_line("gpiochip0:17");
  ASSERT_TRUE(plain.ok());
  EXPECT_EQ(plain->chip, "gpiochip0");
  EXPECT_EQ(plain->line, "17");
  EXPECT_FALSE(plain->active_high);
  const auto other = parse_stop_line("/dev/gpiochip1:GPIO4,active-high");
  ASSERT_TRUE(other.ok());
  EXPECT_EQ(other->chip, "/dev/gpiochip1");
  EXPECT_EQ(other->line, "GPIO4");
  EXPECT_TRUE(other->active_high);
  for (const char* wrong : {"", "17", ":17", "gpiochip0:", "gpiochip0:17,active-low", ",active-high"}) {
    const auto spec = parse_stop_line(wrong);
    ASSERT_FALSE(spec.ok()) << wrong;
    EXPECT_NE(spec.error().find("gpiochip0:17"), std::string::npos);
  }
}

}  // namespace
}  // namespace fencepost::host
