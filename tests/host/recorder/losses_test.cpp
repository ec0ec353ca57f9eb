#include "host/recorder/losses.hpp"

#include <gtest/gtest.h>

#include <string>

namespace fencepost::host {
namespace {

sensor::BlobFrame frame(std::uint32_t number) {
  sensor::BlobFrame frame;
  frame.frame = number;
  return frame;
}

record::StatusReport status(std::uint32_t frames, std::uint32_t records_dropped) {
  record::StatusReport status;
  status.frames = frames;
  status.records_dropped = records_dropped;
  return status;
}

struct LossesTest : testing::Test {
  Losses losses;
};

TEST_F(LossesTest, CountsFramesPassedOver) {
  for (const std::uint32_t number : {5U, 6U, 9U, 10U, 12U}) losses.accept(frame(number));
  EXPECT_EQ(losses.frames_missing(), 3U);  // 7, 8, 11
}

TEST_F(LossesTest, ACameraThatCountsAnewHasNoGap) {
  for (const std::uint32_t number : {100U, 0U, 1U, 3U}) losses.accept(frame(number));
  EXPECT_EQ(losses.frames_missing(), 1U);
}

// A damaged or hostile stream makes up names without end.
TEST_F(LossesTest, KeepsTheFirstDevicesOnly) {
  for (int i = 0; i < 10'000; ++i) {
    record::LinkReport link;
    link.device = sensor::Text("dev" + std::to_string(i));
    losses.accept(link);
  }
  EXPECT_EQ(losses.links().size(), 64U);
  record::LinkReport known;
  known.device = sensor::Text("dev0");
  known.state = sensor::LinkState::kSilent;
  losses.accept(known);
  EXPECT_EQ(losses.links().at("dev0").state, sensor::LinkState::kSilent) << "those go on";
}

TEST_F(LossesTest, ANewRunHasNoGap) {
  losses.accept(frame(5));
  losses.accept(record::Header{});
  losses.accept(frame(500));
  EXPECT_EQ(losses.frames_missing(), 0U);
}

TEST_F(LossesTest, WhatWasLostBeforeTheRecordingDoesNotCount) {
  losses.accept(status(100, 7));
  EXPECT_EQ(losses.reported(), ReportedLosses{});
  record::StatusReport later = status(150, 9);
  later.blobs_dropped = 1;
  later.refused = 4;
  later.rejected = 3;
  losses.accept(later);
  EXPECT_EQ(losses.reported(), (ReportedLosses{2, 1, 4, 3}));
}

TEST_F(LossesTest, ARobotThatBootsAgainCountsFromZero) {
  losses.accept(status(100, 7));
  losses.accept(status(10, 5));
  losses.accept(status(60, 6));
  EXPECT_EQ(losses.reported().records_dropped, 6U);  // 5 since the boot, and 1
}

// `reset` restarts the clock, the counters continue.
TEST_F(LossesTest, ANewRunIsNoBoot) {
  record::StatusReport first = status(100, 7);
  first.t = {100'000};
  losses.accept(first);
  losses.accept(status(101, 7));
  EXPECT_EQ(losses.reported(), ReportedLosses{});
}

TEST_F(LossesTest, ALinkHasTheStateLastTold) {
  record::LinkReport link;
  link.state = sensor::LinkState::kSilent;
  losses.accept(link);
  link.state = sensor::LinkState::kOk;
  losses.accept(link);
  ASSERT_EQ(losses.links().size(), 1U);
  EXPECT_EQ(losses.links().begin()->second.state, sensor::LinkState::kOk);
}

}  // namespace
}  // namespace fencepost::host
