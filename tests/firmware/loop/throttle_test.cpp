// The power of a board's own motors, by a robot that is not known: motors that need power to move at all.
#include "firmware/loop/throttle.hpp"

#include <gtest/gtest.h>

namespace fencepost::loop {
namespace {

constexpr base::Time at_ms(std::int64_t ms) { return base::Time{} + base::milliseconds(ms); }

/// Moves from 20 % of the power on, `per_percent` m/s for each more, and is as fast after a tenth of a second.
class Motors {
 public:
  explicit Motors(double per_percent) : per_percent_(per_percent) {}
  // For 5 ms; odometry is a tenth of a second old.
  double step(std::int32_t power) {
    const double reached = power > 20 ? per_percent_ * (power - 20) : 0;
    speed_ += 0.05 * (reached - speed_);
    told_ += 0.05 * (speed_ - told_);
    return told_;
  }
  [[nodiscard]] double speed() const { return speed_; }

 private:
  double per_percent_;
  double speed_ = 0;
  double told_ = 0;
};

TEST(Throttle, GivesWhatIsWantedWhileNothingLimitsIt) {
  Throttle throttle;
  for (int ms = 0; ms < 2'000; ms += 5) EXPECT_EQ(throttle.judge(40, 1'250, 0.3F, at_ms(ms)), 40);
  EXPECT_EQ(throttle.judge(0, 1'250, 0.3F, at_ms(2'000)), 0);
  EXPECT_EQ(throttle.judge(30, INT16_MAX, 0.3F, at_ms(2'005)), 30);
}

// By an eighth where the robot is faster than its limit.
TEST(Throttle, ChangesOnceInATenthOfASecond) {
  struct Row {
    float speed;
    std::int32_t after, later;
  };
  for (const Row& row : {Row{0.2F, 40, 40}, {0.201F, 35, 30}, {-0.201F, 35, 30}, {0.15F, 40, 40}}) {
    Throttle throttle;
    EXPECT_EQ(throttle.judge(40, 200, row.speed, at_ms(0)), 40);
    EXPECT_EQ(throttle.judge(40, 200, row.speed, at_ms(99)), 40) << row.speed;
    EXPECT_EQ(throttle.judge(40, 200, row.speed, at_ms(100)), row.after) << row.speed;
    EXPECT_EQ(throttle.judge(40, 200, row.speed, at_ms(199)), row.after) << row.speed;
    EXPECT_EQ(throttle.judge(40, 200, row.speed, at_ms(200)), row.later) << row.speed;
  }
}

TEST(Throttle, FollowsALimitThatFalls) {
  for (const double per_percent : {0.004, 0.01, 0.02}) {
    Throttle throttle;
    Motors motors(per_percent);
    double told = 0;
    double limit = 1.25;
    double most_over = 0;
    for (int ms = 0; ms < 4'000; ms += 5) {
      const auto most = static_cast<std::int16_t>(1'000 * limit);
      told = motors.step(throttle.judge(60, most, static_cast<float>(told), at_ms(ms)));
      if (limit > 0.12) limit -= 0.005 * limit / 1.2;
      if (ms > 1'000) most_over = std::max(most_over, motors.speed() / limit);
    }
    EXPECT_LT(most_over, 1.1) << per_percent;
    EXPECT_LT(motors.speed(), 0.15) << per_percent;
    EXPECT_GT(motors.speed(), 0.04) << per_percent << ": it goes on";
  }
}

TEST(Throttle, ComesBackWhenTheWayIsFreeAgain) {
  Throttle throttle;
  for (int ms = 0; ms < 1'000; ms += 5) static_cast<void>(throttle.judge(40, 100, 0.3F, at_ms(ms)));
  EXPECT_LT(throttle.judge(40, 100, 0.3F, at_ms(1'000)), 15);
  for (int ms = 1'000; ms < 6'000; ms += 5) static_cast<void>(throttle.judge(40, 1'250, 0.1F, at_ms(ms)));
  EXPECT_EQ(throttle.judge(40, 1'250, 0.1F, at_ms(6'000)), 40);
}

}  // namespace
}  // namespace fencepost::loop
