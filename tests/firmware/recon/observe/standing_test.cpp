#include "firmware/recon/observe/standing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/firmware/recon/sweep.hpp"

namespace fencepost::test {
namespace {

using recon::MapPose;
using recon::Standing;

MapPose pose(double x, double y = 0, double heading = 0) {
  return {{static_cast<std::int32_t>(std::lround(1e5 * x)), static_cast<std::int32_t>(std::lround(1e5 * y))},
          static_cast<std::int32_t>(std::lround(1e6 * heading))};
}

class Drive {
 public:
  explicit Drive(std::int64_t milliseconds = 40) : frame_(base::milliseconds(milliseconds)) {}
  bool stands(const MapPose& at) {
    standing_.look(at, now_);
    now_ = now_ + frame_;
    return standing_.stands();
  }
  bool stands(const MapPose& at, int frames) {
    for (int i = 1; i < frames; ++i) stands(at);
    return stands(at);
  }
  [[nodiscard]] double since() const { return standing_.since().to_double(); }
  [[nodiscard]] double last() const { return now_.to_double() - frame_.to_double(); }

 private:
  Standing standing_;
  base::Duration frame_;
  base::Time now_ = base::Time::nearest(10);
};

TEST(Standing, BeginsHalfASecondAfterTheLastMotion) {
  Drive drive;
  EXPECT_FALSE(drive.stands(pose(1), 13));
  EXPECT_NEAR(drive.since(), drive.last(), 1e-9) << "not yet";
  EXPECT_TRUE(drive.stands(pose(1)));
  EXPECT_NEAR(drive.since(), 10, 1e-9);
}

// 5 mm and 0.5 degrees, as at level 2 of the studies.
TEST(Standing, NoiseOfTheOdometryIsNoMotion) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Draw draw(seed);
    const auto normal = [&](double sigma) {
      int sum = 0;  // sigma 2000
      for (int i = 0; i < 12; ++i) sum += draw.between(-1000, 1000);
      return sigma * sum / 2000;
    };
    Drive drive;
    for (int i = 0; i < 1000; ++i) {
      const bool stands = drive.stands(pose(normal(0.005), normal(0.005), std::numbers::pi + normal(0.0087)));
      ASSERT_EQ(stands, i >= 13) << "seed " << seed << " frame " << i;
    }
  }
}

TEST(Standing, OneJumpIsNoMotionButABigOneOrThreeAre) {
  Drive drive;
  ASSERT_TRUE(drive.stands(pose(0), 50));
  EXPECT_TRUE(drive.stands(pose(0.03), 2));
  EXPECT_TRUE(drive.stands(pose(0)));
  EXPECT_NEAR(drive.since(), 10, 1e-9);
  EXPECT_TRUE(drive.stands(pose(0, 0.03), 2));
  EXPECT_FALSE(drive.stands(pose(0, 0.03)));
  EXPECT_NEAR(drive.since(), drive.last(), 1e-9);
  ASSERT_TRUE(drive.stands(pose(0, 0.03), 50));
  EXPECT_FALSE(drive.stands(pose(0, 0.03, 0.1))) << "too far for noise";
}

TEST(Standing, ARobotThatCreepsIsFoundToMove) {
  for (const double speed : {0.02, 0.05, 0.1}) {
    Drive drive;
    ASSERT_TRUE(drive.stands(pose(0), 300));
    int frames = 0;
    while (drive.stands(pose(speed * 0.04 * ++frames))) ASSERT_LT(speed * 0.04 * frames, 0.03) << speed;
  }
}

TEST(Standing, ARobotThatDrivesSlowlyNeverStands) {
  for (const int frame : {20, 40, 100, 200}) {
    Drive drive(frame);
    for (int i = 0; i < 500; ++i) ASSERT_FALSE(drive.stands(pose(0.05 * 0.001 * frame * i))) << frame << " ms, " << i;
  }
}

// It slows down from 0.4 m/s: what it averages at first is not where it comes to stand.
TEST(Standing, TheLastStepsOfABrakeAreForgotten) {
  Drive drive;
  for (const double x : {-0.05, -0.036, -0.024, -0.014, -0.006, -0.002}) EXPECT_FALSE(drive.stands(pose(x)));
  EXPECT_TRUE(drive.stands(pose(0), 50));
  EXPECT_TRUE(drive.stands(pose(0.018), 10));
}

}  // namespace
}  // namespace fencepost::test
