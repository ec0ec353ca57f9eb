#include "firmware/recon/observe/pose_history.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/firmware/recon/sweep.hpp"

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

// Ticks of 0.1 ms: gaps of half a second, and times beside, at and between samples, in a ring of four.
TEST(PoseHistory, OfEachTickBesideItsSamples) {
  Draw draw(31);
  Sweep sweep;
  for (int run = 0; run < 1'500; ++run) {
    History history;
    std::int64_t t = draw.of<std::int64_t>({0, 100'000, 0xFFFF'FFF0});
    std::vector<std::int64_t> times;
    if (run % 8 == 1) sweep.tell("nothing", history.at({t}).ok());
    for (int i = draw.between(1, 7); i > 0; --i) {
      const int x = draw.between(-3, 3);
      history.push({{t}, {x * 7}, {draw.between(-3, 3)}, {draw.of({0, 1, -1, 31'415, 31'416, -31'416, 62'832})}});
      times.push_back(t);
      sweep.tell("forward", history.motion(base::Duration{draw.of({0, 1, 5, 4'999, 5'000, 10'000})}).forward);
      sweep.tell("turn", history.motion(base::Duration{draw.of({0, 1, 5, 4'999, 5'000, 10'000})}).turn);
      t += draw.of({1, 2, 3, 4'999, 5'000, 5'001});
    }
    for (const std::int64_t sample : times) {
      for (const int off : {-5'000, -2, -1, 0, 1, 2, 2'500, 5'000}) {
        const auto pose = history.at({sample + off});
        sweep.tell("missing", pose.ok() ? 0 : 1 + static_cast<int>(pose.error()));
        if (!pose.ok()) continue;
        sweep.tell("x", pose->position.x);
        sweep.tell("y", pose->position.y);
        sweep.tell("heading", pose->heading);
      }
    }
    history.clear();
    sweep.tell("cleared", history.at({times.back()}).ok());
    history.push({{t}, {}, {}, {}});
    history.push({{t + 4}, {4}, {}, {}});
    sweep.tell("after a clear", history.at({t + 1}).ok());
  }
  expect_said(sweep, {"forward 3136 23d2cead", "turn 2777 9ab8a818", "missing 28162 7f5570cc", "x 17683 35bdd20a",
                      "y 17762 ededfb3f", "heading 18429 7b1625dd", "cleared 0 22a013d2", "after a clear 1500 93172072",
                      "nothing 0 7a270d46"});
}

// 2^30 ticks are out of reach, one less is only before the first sample.
TEST(PoseHistory, BeyondItsReachEverythingIsTooOld) {
  History history;
  history.push({{0}, {}, {}, {}});
  history.push({{(1LL << 30) - 1}, {}, {}, {}});
  EXPECT_EQ(history.at({1}).error(), PoseMiss::kGap);
  EXPECT_TRUE(history.at({0}).ok());
  EXPECT_EQ(history.at({-1}).error(), PoseMiss::kTooOld);
}

TEST(PoseHistory, TheShortWayEndsAtHalfATurn) {
  constexpr std::int64_t kTurn = 6'283'185;
  constexpr std::int64_t kHalf = kTurn / 2;
  for (const std::int64_t sign : {1, -1}) {
    EXPECT_EQ(recon::short_way(sign * kHalf), sign * kHalf);
    EXPECT_EQ(recon::short_way(sign * (kHalf + 1)), sign * (kHalf + 1 - kTurn));
    EXPECT_EQ(recon::short_way(sign * (kTurn - 1)), -sign);
    EXPECT_EQ(recon::short_way(sign * kTurn), 0);
    EXPECT_EQ(recon::short_way(sign * (kTurn + 1)), sign);
    EXPECT_EQ(recon::short_way(sign * (7 * kTurn + kHalf + 1)), sign * (kHalf + 1 - kTurn));
  }
}

}  // namespace
}  // namespace fencepost::test
