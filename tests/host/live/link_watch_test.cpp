#include "host/live/link_watch.hpp"

#include <gtest/gtest.h>

namespace fencepost::host {
namespace {

using base::milliseconds;
using base::Time;
using sensor::LinkState;

Time at(std::int64_t ms) { return Time{} + milliseconds(ms); }

class LinkWatchTest : public testing::Test {
 protected:
  std::optional<LinkNews> observe(LinkState state, std::int64_t ms) { return watch.observe(state, problem, at(ms)); }

  std::string problem;
  LinkWatch watch{DeviceRole::kCamera, *parse_device("pixy2:/dev/ttyUSB0", DeviceRole::kCamera)};
};

TEST_F(LinkWatchTest, TellsOnceThatItWorks) {
  const auto news = observe(LinkState::kOk, 5);
  ASSERT_TRUE(news.has_value());
  EXPECT_EQ(news->report.t, at(5));
  EXPECT_EQ(news->report.device.view(), "pixy2");
  EXPECT_EQ(news->report.state, LinkState::kOk);
  EXPECT_EQ(news->report.detail.view(), "/dev/ttyUSB0");
  EXPECT_EQ(news->sentence, "camera pixy2 at /dev/ttyUSB0 works");
  EXPECT_FALSE(observe(LinkState::kOk, 6).has_value());
}

TEST_F(LinkWatchTest, TellsGoneAndBackAtOnce) {
  EXPECT_TRUE(observe(LinkState::kOk, 0).has_value());
  problem = "cannot open it";
  const auto gone = observe(LinkState::kAbsent, 10);
  ASSERT_TRUE(gone.has_value());
  EXPECT_EQ(gone->sentence,
            "camera pixy2 at /dev/ttyUSB0 is absent; going on without it until it is back: cannot open it");
  EXPECT_FALSE(observe(LinkState::kAbsent, 20).has_value());
  EXPECT_FALSE(observe(LinkState::kAbsent, 100'000).has_value());
  EXPECT_TRUE(observe(LinkState::kOk, 100'001).has_value());
}

TEST_F(LinkWatchTest, WhatPassesIsNotTold) {
  EXPECT_FALSE(observe(LinkState::kSilent, 0).has_value()) << "a device that starts";
  EXPECT_FALSE(observe(LinkState::kUnready, 900).has_value());
  EXPECT_TRUE(observe(LinkState::kOk, 1'000).has_value());
  EXPECT_FALSE(observe(LinkState::kEmpty, 1'100).has_value()) << "a blob that flickers";
  EXPECT_FALSE(observe(LinkState::kOk, 2'000).has_value());
  EXPECT_FALSE(observe(LinkState::kEmpty, 2'100).has_value());
  EXPECT_FALSE(observe(LinkState::kEmpty, 3'099).has_value());
  EXPECT_TRUE(observe(LinkState::kEmpty, 3'100).has_value());
}

TEST_F(LinkWatchTest, SaysWhatToTry) {
  EXPECT_FALSE(observe(LinkState::kSilent, 0).has_value());
  EXPECT_NE(observe(LinkState::kSilent, 1'000)->sentence.find("TX to RX"), std::string::npos);
  EXPECT_FALSE(observe(LinkState::kUnready, 1'100).has_value());
  EXPECT_NE(observe(LinkState::kUnready, 2'100)->sentence.find("its button is held"), std::string::npos);
}

}  // namespace
}  // namespace fencepost::host
