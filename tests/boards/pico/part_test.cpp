// More functions of the Pico's part: settings in flash, the watchdog, panics.
#include <gtest/gtest.h>

#include <cstdio>

#include <nlohmann/json.hpp>

#include "tests/boards/bench.hpp"
#include "tests/boards/pico/pico.hpp"
#include "tests/firmware/loop/desk.hpp"

namespace fencepost::test {
namespace {

struct PicoPart : ::testing::Test {
  EmulatedPico* machine = nullptr;
  Bench bench{pico(&machine)};

  void SetUp() override { ASSERT_TRUE(bench.await("READY\r\n")) << bench.said(); }
  void restart(const std::string& how) {
    bench.clear();
    machine->command(how);
    ASSERT_TRUE(bench.await("READY\r\n")) << how << ": " << bench.said();
  }
  nlohmann::json counts() { return nlohmann::json::parse(machine->ask("counts")); }
};

TEST_F(PicoPart, KeepsSettingsOverResetsAndPowerCuts) {
  ASSERT_TRUE(bench.obey("set alert.stop 0.30", "alert.stop = 0.30")) << bench.said();
  bench.run(0.1);
  EXPECT_GT(counts()["programmed"], 0);
  restart("run-pin");
  EXPECT_NE(bench.said().find("reset: reset pin"), std::string::npos) << bench.said();
  EXPECT_TRUE(bench.obey("get alert.stop", "alert.stop = 0.30"));
  restart("power");
  EXPECT_NE(bench.said().find("reset: power on"), std::string::npos) << bench.said();
  EXPECT_TRUE(bench.obey("get alert.stop", "alert.stop = 0.30"));
}

// Each call of the ROM's holds all interrupts: a line of some 100 bytes is not written word by word.
TEST_F(PicoPart, HoldsInterruptsFewTimesForALine) {
  ASSERT_TRUE(bench.obey("set alert.stop 0.30", "alert.stop = 0.30"));
  bench.run(0.1);
  const int before = counts()["programmed"].get<int>();
  bench.console().send(line_of(level_pixy2()));
  bench.run(0.2);
  const int calls = counts()["programmed"].get<int>() - before;
  EXPECT_GE(calls, 3);
  EXPECT_LE(calls, 6) << "its length, its words, what is left of it, its check, and once more where a page begins";
}

// Some 36 bytes a change: the page of 4096 is full more than once.
TEST_F(PicoPart, GoesOnInTheOtherSectorWhenOneIsFull) {
  for (int i = 0; i < 260; ++i) {
    std::array<char, 40> command{};
    std::snprintf(command.data(), command.size(), "set alert.warn 1.%02d", i % 100);
    ASSERT_TRUE(bench.obey(command.data(), "alert.warn = ")) << i << ": " << bench.said();
    bench.run(0.02);
  }
  EXPECT_GE(counts()["erased"], 1);
  restart("power");
  EXPECT_TRUE(bench.obey("get alert.warn", "alert.warn = 1.59"));
}

TEST_F(PicoPart, APowerCutInTheMiddleLosesTheLastChangeAtMost) {
  ASSERT_TRUE(bench.obey("set alert.stop 0.30", "alert.stop = 0.30"));
  bench.run(0.1);
  for (int milliseconds = 1; milliseconds < 24; milliseconds += 2) {
    bench.console().send("set alert.warn 0.66\r");
    bench.run(0.001 * milliseconds);
    restart("power");
    EXPECT_TRUE(bench.obey("get alert.stop", "alert.stop = 0.30")) << milliseconds;
    const bool kept = bench.obey("get alert.warn", "alert.warn = 0.66");
    EXPECT_TRUE(kept || bench.said().find("alert.warn = 0.50") != std::string::npos) << bench.said();
    ASSERT_TRUE(bench.obey("set alert.warn 0.50", "alert.warn = 0.50"));
    bench.run(0.1);
  }
}

TEST_F(PicoPart, TellsOnceWhereTheLastRunDied) {
  restart("fault");
  EXPECT_NE(bench.said().find("reset: panic\r\npanic: exception 3 at 200"), std::string::npos) << bench.said();
  restart("run-pin");
  EXPECT_NE(bench.said().find("reset: reset pin\r\npanic: none"), std::string::npos) << bench.said();
}

// It resets the core alone: the clocks run on PLLs, the timer may stand still. tests/boards/pico/rules.mjs says where
// that would hang the part.
TEST_F(PicoPart, StartsAfterADebugProbe) {
  restart("probe");
  EXPECT_TRUE(bench.obey("version", "for pico")) << bench.said();
  restart("probe");
  EXPECT_TRUE(bench.obey("selftest", "selftest pass")) << bench.said();
}

TEST_F(PicoPart, TheWatchdogEndsAnEndlessLoop) {
  bench.clear();
  machine->command("hang");
  bench.run(0.35);
  EXPECT_EQ(bench.said(), "");
  ASSERT_TRUE(bench.await("READY\r\n", 2)) << bench.said();
  EXPECT_NE(bench.said().find("reset: watchdog\r\npanic: none"), std::string::npos) << bench.said();
}

}  // namespace
}  // namespace fencepost::test
