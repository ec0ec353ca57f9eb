// When a robot may drive.
#include "firmware/loop/motion_permit.hpp"

#include <gtest/gtest.h>

namespace fencepost::loop {
namespace {

using record::AlertLevel;
using sensor::LinkState;

constexpr base::Time at_ms(std::int64_t ms) { return base::Time{} + base::milliseconds(ms); }

record::Heartbeat beat(AlertLevel level, LinkState camera = LinkState::kOk, LinkState odometry = LinkState::kOk) {
  return {at_ms(100), level, camera, odometry};
}
bool judged(const record::Heartbeat& beat, const console::Links& links = {LinkState::kOk, LinkState::kOk}) {
  return MotionPermit().judge(beat, links, at_ms(5'000));
}

TEST(MotionPermit, BelowStopWithBothSensorsAtWork) {
  EXPECT_TRUE(judged(beat(AlertLevel::kClear)));
  EXPECT_TRUE(judged(beat(AlertLevel::kNotice)));
  EXPECT_TRUE(judged(beat(AlertLevel::kWarn)));
  EXPECT_FALSE(judged(beat(AlertLevel::kStop)));
  EXPECT_FALSE(judged(beat(AlertLevel::kBlind)));
}

TEST(MotionPermit, AnEmptyViewIsNoFault) {
  EXPECT_TRUE(judged(beat(AlertLevel::kClear, LinkState::kEmpty), {LinkState::kEmpty, LinkState::kEmpty}));
  for (const LinkState state : {LinkState::kAbsent, LinkState::kSilent, LinkState::kUnready}) {
    EXPECT_FALSE(judged(beat(AlertLevel::kClear, state))) << name(state);
    EXPECT_FALSE(judged(beat(AlertLevel::kClear, LinkState::kOk, state))) << name(state);
    EXPECT_FALSE(judged(beat(AlertLevel::kClear), {state, LinkState::kOk})) << name(state);
    EXPECT_FALSE(judged(beat(AlertLevel::kClear), {LinkState::kOk, state})) << name(state);
  }
}

// By the robot's own clock: a stream whose sender died stands still.
TEST(MotionPermit, EndsWhenStreamTimeStandsStill) {
  MotionPermit permit;
  const console::Links links{LinkState::kOk, LinkState::kOk};
  record::Heartbeat now = beat(AlertLevel::kClear);
  EXPECT_TRUE(permit.judge(now, links, at_ms(1'000)));
  EXPECT_TRUE(permit.judge(now, links, at_ms(1'300)));
  EXPECT_FALSE(permit.judge(now, links, at_ms(1'301)));
  now.t = at_ms(50);  // a new run begins at 0
  EXPECT_TRUE(permit.judge(now, links, at_ms(1'400)));
}

// Input that waited for a blocked loop is stale, and so is the state of the sensors that it shows.
TEST(MotionPermit, ComesBackWhenTheStreamHasCaughtUp) {
  MotionPermit permit;
  const console::Links links{LinkState::kOk, LinkState::kOk};
  record::Heartbeat now = beat(AlertLevel::kClear);
  now.t = at_ms(7'000);
  EXPECT_TRUE(permit.judge(now, links, at_ms(1'000)));
  now.t = at_ms(7'020);
  EXPECT_FALSE(permit.judge(now, links, at_ms(3'200)));
  now.t = at_ms(8'800);
  EXPECT_FALSE(permit.judge(now, links, at_ms(3'203)));
  now.t = at_ms(9'000);
  EXPECT_TRUE(permit.judge(now, links, at_ms(3'205))) << "0.2 s behind, as it may be";
}

TEST(MotionPermit, ComesBackAfterAPausedSenderWentOn) {
  MotionPermit permit;
  const console::Links links{LinkState::kOk, LinkState::kOk};
  record::Heartbeat now = beat(AlertLevel::kClear);
  now.t = at_ms(7'000);
  EXPECT_TRUE(permit.judge(now, links, at_ms(1'000)));
  for (int ms = 0; ms <= 500; ms += 50) {
    now.t = at_ms(7'010 + ms);
    EXPECT_EQ(permit.judge(now, links, at_ms(3'200 + ms)), ms > 300) << ms;
  }
}

TEST(MotionPermit, MayBeAskedSeldom) {
  MotionPermit permit;
  const console::Links links{LinkState::kOk, LinkState::kOk};
  record::Heartbeat now = beat(AlertLevel::kClear);
  for (int s = 1; s < 10; ++s) {
    now.t = at_ms(7'000 + 1'000 * s);
    EXPECT_TRUE(permit.judge(now, links, at_ms(1'000 * s))) << s;
  }
}

TEST(DrivePermit, WhoStoppedGoesOnWhenNothingWarns) {
  DrivePermit permit;
  const record::SpeedLimit limit{{}, base::Metres{4'567}};
  EXPECT_EQ(permit.judge(false, AlertLevel::kBlind, limit), 0);
  EXPECT_EQ(permit.judge(true, AlertLevel::kNotice, limit), 456) << "mm/s, rounded down";
  EXPECT_EQ(permit.judge(true, AlertLevel::kWarn, limit), 456) << "a warning stops nobody";
  EXPECT_EQ(permit.judge(false, AlertLevel::kStop, limit), 0);
  EXPECT_EQ(permit.judge(true, AlertLevel::kWarn, limit), 0) << "it stands: no closer, and still there";
  EXPECT_EQ(permit.judge(true, AlertLevel::kClear, limit), 456);
}

TEST(DrivePermit, WhatIsNotKnownLimitsNoSpeed) {
  EXPECT_EQ(most_of({}), INT16_MAX);
  EXPECT_EQ(most_of({{}, base::Metres{0}}), 0);
  EXPECT_EQ(most_of({{}, base::Metres{30'000'000}}), INT16_MAX);
}

}  // namespace
}  // namespace fencepost::loop
