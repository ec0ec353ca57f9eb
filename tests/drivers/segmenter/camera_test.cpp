#include "drivers/segmenter/camera.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <memory>
#include <tuple>
#include <vector>

namespace fencepost::segmenter {
namespace {

using base::Error;
using base::milliseconds;
using base::Result;
using base::Time;
using sensor::LinkState;

/// Answers as they were put into it, then nothing.
struct Script {
  Result<bus::Picture> next() {
    if (answers.empty()) return Error::kNotReady;
    const Result<bus::Picture> answer = answers.front();
    answers.pop_front();
    return answer;
  }
  std::deque<Result<bus::Picture>> answers;
};
static_assert(bus::PictureSource<Script>);
static_assert(sensor::BlobCamera<Camera<Script>>);

/// Grey with a red box on it, RGB.
std::vector<std::uint8_t> painted(int width, int height, int x1, int y1, int x2, int y2) {
  std::vector<std::uint8_t> bytes;
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const bool red = u >= x1 && u <= x2 && v >= y1 && v <= y2;
      const std::uint8_t rest = red ? 20 : 200;
      bytes.insert(bytes.end(), {200, rest, rest});
    }
  }
  return bytes;
}

bus::Picture picture(const std::vector<std::uint8_t>& bytes, std::uint16_t width, std::uint16_t height, Time t) {
  return {bus::PixelLayout::kRgb, width, height, std::size_t{3} * width, bytes, t};
}

Config config() {
  Config config;
  (void)config.ranges.push_back({7, {7'000}, {10'000}, {0}, {1'500}, 20, 255});
  config.rules = {4, 0};
  return config;
}

class SegmenterCamera : public testing::Test {
 protected:
  Script script_;
  std::unique_ptr<Camera<Script>> camera_ = std::make_unique<Camera<Script>>(script_, config());
};

TEST_F(SegmenterCamera, GivesTheBoxesOfAPicture) {
  const auto bytes = painted(40, 30, 10, 5, 19, 14);
  const Time t = Time{} + milliseconds(123);
  script_.answers = {picture(bytes, 40, 30, t), picture(bytes, 40, 30, t + milliseconds(33))};
  const auto frame = camera_->poll(t);
  ASSERT_TRUE(frame.ok());
  EXPECT_EQ(frame->t, t);
  EXPECT_EQ(frame->frame, 0U);
  ASSERT_EQ(frame->blobs.size(), 1U);
  const sensor::Blob& blob = frame->blobs[0];
  EXPECT_EQ(blob.signature, 7);
  EXPECT_EQ(std::tuple(blob.x1, blob.y1, blob.x2, blob.y2), std::tuple(10, 5, 19, 14));
  EXPECT_EQ(blob.pixels, 100U);
  EXPECT_EQ(blob.cx.raw, 145);
  EXPECT_EQ(blob.cy.raw, 95);
  EXPECT_EQ(camera_->link(), LinkState::kOk);
  EXPECT_EQ(camera_->poll(t)->frame, 1U);
  EXPECT_EQ(camera_->poll(t).error(), Error::kNotReady);
}

TEST_F(SegmenterCamera, SaysHowItIs) {
  const auto bytes = painted(40, 30, 10, 5, 19, 14);
  const auto grey = painted(40, 30, -1, -1, -1, -1);
  EXPECT_EQ(camera_->link(), LinkState::kSilent);
  script_.answers = {Error::kBadInput, picture(grey, 40, 30, {}), picture(bytes, 40, 30, {})};
  EXPECT_FALSE(camera_->poll(Time{}).ok());
  EXPECT_EQ(camera_->link(), LinkState::kUnready);
  EXPECT_TRUE(camera_->poll(Time{}).ok());
  EXPECT_EQ(camera_->link(), LinkState::kEmpty);
  EXPECT_TRUE(camera_->poll(Time{}).ok());
  EXPECT_EQ(camera_->link(), LinkState::kOk);
  EXPECT_FALSE(camera_->poll(Time{} + milliseconds(999)).ok());
  EXPECT_EQ(camera_->link(), LinkState::kOk);
  EXPECT_FALSE(camera_->poll(Time{} + milliseconds(1'000)).ok());
  EXPECT_EQ(camera_->link(), LinkState::kSilent);
  script_.answers = {picture(bytes, 40, 30, {}), Error::kGone};
  EXPECT_TRUE(camera_->poll(Time{} + milliseconds(1'100)).ok());
  EXPECT_EQ(camera_->link(), LinkState::kOk);
  EXPECT_FALSE(camera_->poll(Time{} + milliseconds(1'101)).ok());
  EXPECT_EQ(camera_->link(), LinkState::kSilent);
}

TEST(SegmenterProfile, IsThatOfTheSameLens) {
  for (const auto& [width, height, longer] : {std::tuple(640, 480, 640), {240, 320, 320}, {320, 240, 320}}) {
    const auto profile = profile_of(static_cast<std::uint16_t>(width), static_cast<std::uint16_t>(height));
    EXPECT_EQ(std::tuple(int{profile.width}, int{profile.height}), std::tuple(width, height));
    EXPECT_NEAR(profile.fx.to_double(), longer / 2 / std::tan(M_PI / 6), 0.02);
    EXPECT_EQ(profile.fy, profile.fx);
    EXPECT_EQ(profile.cx.raw, 50 * (width - 1));
    EXPECT_EQ(profile.cy.raw, 50 * (height - 1));
    const BlobRules usual, rules = rules_of(static_cast<std::uint16_t>(width), static_cast<std::uint16_t>(height));
    EXPECT_EQ(rules.min_pixels, usual.min_pixels * static_cast<unsigned>(width * height) / (320 * 240));
    EXPECT_EQ(rules.max_gap, usual.max_gap * width / 320);
  }
}

TEST_F(SegmenterCamera, WithoutColoursItIsNotReady) {
  const auto camera = std::make_unique<Camera<Script>>(script_, Config{});
  const auto bytes = painted(40, 30, 10, 5, 19, 14);
  script_.answers = {picture(bytes, 40, 30, {})};
  const auto frame = camera->poll(Time{});
  ASSERT_TRUE(frame.ok());
  EXPECT_TRUE(frame->blobs.empty());
  EXPECT_EQ(camera->link(), LinkState::kUnready);
}

TEST_F(SegmenterCamera, RefusesAPictureThatIsNotWhole) {
  const auto bytes = painted(40, 30, 10, 5, 19, 14);
  const bus::Picture good = picture(bytes, 40, 30, {});
  std::vector<bus::Picture> bad(7, good);
  bad[0].bytes = good.bytes.first(good.bytes.size() - 1);
  bad[1].stride = 119;
  bad[2].width = 0;
  bad[3].height = 0;
  bad[4].height = 31;
  bad[5].width = BlobFinder::kMaxWidth + 1;
  bad[6].height = BlobFinder::kMaxHeight + 1;
  for (const bus::Picture& one : bad) {
    script_.answers = {one, good};
    EXPECT_EQ(camera_->poll(Time{}).error(), Error::kBadInput);
    EXPECT_EQ(camera_->link(), LinkState::kUnready);
    EXPECT_TRUE(camera_->poll(Time{}).ok());
  }
}

TEST_F(SegmenterCamera, FollowsAChangeOfLayout) {
  const auto bytes = painted(40, 30, 10, 5, 19, 14);
  // Red 200, 20, 20 is Y 73.8, U 97.6, V 218 in full range; two pixels by two rows of it.
  const std::vector<std::uint8_t> yuyv = {74, 98, 74, 218, 74, 98, 74, 218};
  script_.answers = {picture(bytes, 40, 30, {}), bus::Picture{bus::PixelLayout::kYuyvFull, 2, 2, 4, yuyv, {}},
                     picture(bytes, 40, 30, {})};
  EXPECT_EQ(camera_->poll(Time{})->blobs[0].pixels, 100U);
  EXPECT_EQ(camera_->poll(Time{})->blobs[0].pixels, 4U);
  EXPECT_EQ(camera_->poll(Time{})->blobs[0].pixels, 100U);
}

}  // namespace
}  // namespace fencepost::segmenter
