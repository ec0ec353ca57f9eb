#include "firmware/recon/observe/pose_history.hpp"

#include <gtest/gtest.h>

namespace fencepost::test {
namespace {

using recon::MapPose;
using recon::PoseMiss;
using History = recon::PoseHistory<4>;

sensor::OdometrySample sample(double t, double x, double y, double heading) {
  return {base::Time::nearest(t), base::Metres::nearest(x), base::Metres::nearest(y), base::Radians::nearest(heading)};
}
base::Time at(double t) { return base::Time::nearest(t); }

TEST(PoseHistory, InterpolatesBetweenTwoSamples) {
  History history;
  history.push(sample(1.0, 0.0, 2.0, 0.1));
  history.push(sample(1.1, 0.1, 1.9, 0.3));
  const auto pose = history.at(at(1.025));  // a quarter of the way
  ASSERT_TRUE(pose.ok());
  EXPECT_EQ(pose->position.x, 2'500);    // 0.025 m in 10 um
  EXPECT_EQ(pose->position.y, 197'500);  // 1.975 m
  EXPECT_EQ(pose->heading, 150'000);     // 0.15 rad in urad
}

TEST(PoseHistory, GivesSamplesBackExactly) {
  History history;
  history.push(sample(1.0, -0.1234, 2.0, -3.1));
  history.push(sample(1.1, 5.0, 1.9, 0.3));
  EXPECT_EQ(history.at(at(1.0)).value(), (MapPose{{-12'340, 200'000}, -3'100'000}));
  EXPECT_EQ(history.at(at(1.1)).value(), (MapPose{{500'000, 190'000}, 300'000}));
}

TEST(PoseHistory, TurnsTheShortWayRound) {
  for (const double turns : {0.0, 2 * 3.14159265, -4 * 3.14159265}) {
    History history;
    history.push(sample(0.0, 0, 0, 3.1));
    history.push(sample(0.1, 0, 0, -3.1 + turns));  // 0.0832 rad further on
    const auto pose = history.at(at(0.05));
    ASSERT_TRUE(pose.ok());
    EXPECT_NEAR(pose->heading, 3'141'593, 100) << turns;
  }
}

TEST(PoseHistory, AnythingBelowHalfATurnIsTheShortWay) {
  for (const double turn : {2.5, -2.5, 3.1, -3.1}) {
    History history;
    history.push(sample(0.0, 0, 0, 0.4));
    history.push(sample(0.1, 0, 0, 0.4 + turn));
    EXPECT_NEAR(history.at(at(0.05))->heading, 1e6 * (0.4 + turn / 2), 100) << turn;
  }
}

TEST(PoseHistory, SaysWhyThereIsNoPose) {
  History history;
  EXPECT_EQ(history.at(at(1)).error(), PoseMiss::kNotYet);
  history.push(sample(1.0, 0, 0, 0));
  EXPECT_EQ(history.at(at(0.9999)).error(), PoseMiss::kTooOld);
  EXPECT_EQ(history.at(at(1.0001)).error(), PoseMiss::kNotYet);
  history.push(sample(1.5, 0, 0, 0));  // exactly 0.5 s: still bridged
  EXPECT_TRUE(history.at(at(1.25)).ok());
  history.push(sample(2.0001, 0, 0, 0));
  EXPECT_EQ(history.at(at(1.6)).error(), PoseMiss::kGap);
  EXPECT_TRUE(history.at(at(1.5)).ok());
  EXPECT_TRUE(history.at(at(2.0001)).ok());
}

TEST(PoseHistory, ForgetsTheOldestWhenFull) {
  History history;
  for (int i = 0; i < 6; ++i) history.push(sample(0.1 * i, 0.1 * i, 0, 0));
  EXPECT_EQ(history.at(at(0.15)).error(), PoseMiss::kTooOld);
  EXPECT_TRUE(history.at(at(0.2)).ok());
  EXPECT_TRUE(history.at(at(0.5)).ok());
}

TEST(PoseHistory, WorksAcrossTheWrapOfItsTickCounter) {
  const double wrap = 4294967296.0 / 10000;  // low word of the 0.1 ms count, after 119 hours
  History history;
  history.push(sample(wrap - 0.05, 1.0, 0, 0));
  history.push(sample(wrap + 0.05, 2.0, 0, 0));
  const auto pose = history.at(at(wrap));
  ASSERT_TRUE(pose.ok());
  EXPECT_NEAR(pose->position.x, 150'000, 200);
}

TEST(PoseHistory, MeasuresSpeedAndTurn) {
  History history;
  EXPECT_EQ(history.motion(base::milliseconds(200)).forward, 0.0F);
  // Facing +y, driving forwards 0.02 m every 0.1 s, turning 0.01 rad every 0.1 s.
  for (int i = 0; i < 4; ++i) history.push(sample(0.1 * i, 0, 0.02 * i, 1.5708 + 0.01 * i));
  const recon::Motion motion = history.motion(base::milliseconds(200));
  EXPECT_NEAR(motion.forward, 0.2F, 2e-3F);
  EXPECT_NEAR(motion.turn, 0.1F, 1e-3F);
  history.push(sample(0.4, 0, 0.02, 1.6108));  // backwards now
  EXPECT_LT(history.motion(base::milliseconds(50)).forward, -0.3F);
}

}  // namespace
}  // namespace fencepost::test
