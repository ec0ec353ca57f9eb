// A Pico that drives at a post, and the changes of its outputs.
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/boards/bench.hpp"
#include "tests/boards/pico/pico.hpp"
#include "tests/firmware/loop/desk.hpp"

namespace fencepost::test {

class DrivenPico : public ::testing::Test {
 protected:
  explicit DrivenPico(const std::string& image = "fencepost")
      : bench(pico(&machine, image)), ready_(image == "fencepost" ? "READY\r\n" : "panic: none\r\n") {}
  void SetUp() override { ASSERT_TRUE(bench.await(ready_)) << bench.said(); }

  /// Towards a post whose front is a metre ahead of where it began, with 50 samples and 25 frames a second.
  void drive(double seconds, bool frames = true, bool odometry = true) {
    for (const double end = t_ + seconds - 1e-9; t_ < end; t_ += 0.02, x_ += 0.02 * speed_) {
      if (odometry) bench.console().send(unstamped(desk_odometry(t_, x_)));
      if (frames && number_++ % 2 == 0) bench.give(desk_frame(t_, number_, x_));
      bench.run(0.02);
    }
  }
  /// Ready to drive, in mode log.
  void set_off() {
    ASSERT_TRUE(bench.await_camera()) << bench.said();
    ASSERT_TRUE(bench.obey("mode log", "mode is log"));
    drive(1.0);
    ASSERT_TRUE(high()) << bench.said();
  }

  struct Change {
    double t = 0;  ///< s of the machine's clock
    bool high = false;
  };
  /// Of STOP; or, by `which`, of a motor's pin.
  std::vector<Change> changes(const std::string& which = "stop") {
    std::vector<Change> all;
    for (const auto& one : nlohmann::json::parse(machine->ask(which)))
      all.push_back({one[0].get<double>() * 1e-6, one[1].get<int>() != 0});
    return all;
  }
  bool high(const std::string& which = "stop") {
    const std::vector<Change> all = changes(which);
    return !all.empty() && all.back().high;
  }
  /// When it fell the last time; it is low.
  double fallen(const std::string& which = "stop") {
    const std::vector<Change> all = changes(which);
    EXPECT_TRUE(!all.empty() && !all.back().high);
    return all.empty() ? 0 : all.back().t;
  }

  EmulatedPico* machine = nullptr;
  Bench bench;
  double speed_ = 0.16;  ///< m/s

 private:
  std::string ready_;  ///< the last line of a start; who comes by USB later does not hear READY
  double t_ = 0;
  double x_ = 0;
  std::uint32_t number_ = 0;
};

}  // namespace fencepost::test
