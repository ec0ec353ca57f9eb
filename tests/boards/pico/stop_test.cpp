// The pin that stops the motors, traced: high only while the robot may drive.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/boards/pico/driven_pico.hpp"

namespace fencepost::test {
namespace {

using PicoStop = DrivenPico;

TEST_F(PicoStop, IsLowUntilFramesAndOdometryCome) {
  EXPECT_TRUE(changes().empty()) << "never high since the power came";
  ASSERT_TRUE(bench.await_camera()) << bench.said();
  drive(0.5, true, false);
  EXPECT_TRUE(changes().empty()) << "no odometry";
  bench.unplug_camera(true);
  bench.run(2);
  drive(0.5, false, true);
  EXPECT_TRUE(changes().empty()) << "no frames";
}

TEST_F(PicoStop, FallsWithTheRecordThatSaysStop) {
  set_off();
  bench.clear();
  double said = 0;
  for (int i = 0; i < 300 && said == 0; ++i) {
    drive(0.02);
    if (bench.said().find(",stop,") != std::string::npos) said = bench.seconds();
  }
  ASSERT_GT(said, 0) << bench.said().substr(0, 2'000);
  bench.run(0.03);
  const double low = fallen();
  EXPECT_LE(low, said + 0.02);
  // The record waits for a slow line; 20 ms are the step that this test looks with.
  EXPECT_GE(low, said - 0.1) << "not for another reason";
}

TEST_F(PicoStop, FallsWhenASensorFallsSilent) {
  set_off();
  const double last = bench.seconds();
  drive(0.6, true, false);
  EXPECT_LE(fallen() - last, 0.4) << "no odometry";
  drive(1.0);
  ASSERT_TRUE(high());
  const double gone = bench.seconds();
  bench.unplug_camera(true);
  drive(0.6, false, true);
  EXPECT_LE(fallen() - gone, 0.4) << "no camera";
}

TEST_F(PicoStop, FallsWhenTheLoopHangs) {
  set_off();
  const double begun = bench.seconds();
  machine->command("hang");
  bench.run(0.6);
  EXPECT_LE(fallen() - begun, 0.5);
  EXPECT_GE(fallen() - begun, 0.3) << "it was the watchdog";
  ASSERT_TRUE(bench.await("reset: watchdog", 2)) << bench.said();
  EXPECT_FALSE(high()) << "and stays low in the next run";
}

TEST_F(PicoStop, FallsAtOnceInAPanic) {
  set_off();
  const double begun = bench.seconds();
  machine->command("fault");
  bench.run(0.1);
  EXPECT_LE(fallen() - begun, 0.001);
}

// A page of settings that is full is erased, for 0.4 s at most: the motors stand, and the watchdog waits.
TEST_F(PicoStop, IsLowWhileTheFlashIsErased) {
  set_off();
  speed_ = 0;
  for (int i = 0; i < 400; ++i) {
    bench.console().send(i % 2 == 0 ? "set alert.warn 0.66\r" : "set alert.warn 0.65\r");
    drive(0.06);
  }
  const auto counts = nlohmann::json::parse(machine->ask("counts"));
  ASSERT_GE(counts["erased"].get<int>(), 1);
  drive(1.0);
  EXPECT_TRUE(high());
  double longest = 0;
  double fell = 0;
  for (const Change& change : changes()) {
    if (!change.high) fell = change.t;
    if (change.high && fell > 0) longest = std::max(longest, change.t - fell);
  }
  EXPECT_GE(longest, 0.4) << "it fell before the erasing, and rose after it";
  EXPECT_EQ(bench.said().find("reset: watchdog"), std::string::npos) << "it did not bite";
}

}  // namespace
}  // namespace fencepost::test
