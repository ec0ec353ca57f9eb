#include "host/video/colour_training.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/host/video/files.hpp"

namespace fencepost::host {
namespace {

using segmenter::signature_of;
using testing::paint;
using testing::plain;

constexpr sensor::Rgb kGrey{120, 120, 120};
constexpr sensor::Rgb kOrange{230, 110, 30};
constexpr sensor::Rgb kYellow{220, 180, 40};

void shake(RgbPicture& picture, int levels) {
  std::mt19937 random(5);
  const auto shaken = [&](std::uint8_t level) {
    const int by = static_cast<int>(random() % static_cast<unsigned>(2 * levels + 1)) - levels;
    return static_cast<std::uint8_t>(std::clamp(level + by, 0, 255));
  };
  for (sensor::Rgb& rgb : picture.pixels) rgb = {shaken(rgb.red), shaken(rgb.green), shaken(rgb.blue)};
}

std::uint8_t found(const TrainedColour& colour, sensor::Rgb rgb, double light = 1) {
  const auto lit = [&](std::uint8_t level) { return static_cast<int>(level * light); };
  return signature_of({&colour.range, 1}, lit(rgb.red), lit(rgb.green), lit(rgb.blue));
}

TEST(TrainColours, FindsTheThingInOtherLightAndNothingElse) {
  RgbPicture picture = plain(80, 60, kGrey);
  paint(picture, 20, 20, 49, 39, kOrange);
  shake(picture, 6);
  const TrainingBox box{25, 25, 15, 10, 3};
  const auto trained = train_colours(picture, {&box, 1});
  ASSERT_EQ(trained.size(), 1U);
  const TrainedColour& orange = trained[0];
  EXPECT_EQ(orange.range.signature, 3);
  EXPECT_NEAR(orange.rgb.red, 230, 2);
  EXPECT_NEAR(orange.rgb.green, 110, 2);
  EXPECT_NEAR(orange.rgb.blue, 30, 2);
  EXPECT_GT(orange.found, 0.95);
  EXPECT_EQ(orange.elsewhere, 0U);
  for (const double light : {1.0, 0.7, 0.4, 0.3}) {
    EXPECT_EQ(found(orange, kOrange, light), 3) << light;
    EXPECT_EQ(found(orange, kGrey, light), 0) << light;
  }
  EXPECT_EQ(found(orange, kOrange, 0.1), 0) << "too dark for a colour";
}

TEST(TrainColours, ReachesLessFarWhereSomethingLooksAlmostTheSame) {
  RgbPicture alone = plain(80, 60, kGrey);
  paint(alone, 5, 5, 34, 34, kOrange);
  RgbPicture beside = alone;
  paint(beside, 45, 5, 74, 34, {230, 132, 30});  // a green share of 0.337 beside 0.297
  const TrainingBox box{10, 10, 20, 20, 1};
  const TrainedColour free = train_colours(alone, {&box, 1})[0];
  const TrainedColour narrow = train_colours(beside, {&box, 1})[0];
  EXPECT_GT(free.range.green_max, narrow.range.green_max);
  EXPECT_LT(narrow.range.green_max.to_double(), 0.33);
  EXPECT_EQ(narrow.elsewhere, 0U);
  EXPECT_DOUBLE_EQ(narrow.found, 1);
}

TEST(TrainColours, TakesBoxesOfOneSignatureTogether) {
  RgbPicture picture = plain(80, 60, kGrey);
  paint(picture, 5, 5, 30, 30, kOrange);
  paint(picture, 40, 5, 70, 30, {115, 55, 15});  // in shadow
  paint(picture, 5, 40, 30, 55, kYellow);
  const std::vector<TrainingBox> boxes = {{8, 8, 10, 10, 1}, {8, 43, 10, 8, 2}, {45, 8, 10, 10, 1}};
  const auto trained = train_colours(picture, boxes);
  ASSERT_EQ(trained.size(), 2U);
  EXPECT_EQ(trained[0].range.signature, 1);
  EXPECT_EQ(trained[1].range.signature, 2);
  EXPECT_EQ(found(trained[0], kOrange), 1);
  EXPECT_EQ(found(trained[0], kYellow), 0);
  EXPECT_EQ(found(trained[1], kYellow), 2);
  EXPECT_EQ(found(trained[1], kOrange), 0);
}

TEST(TrainColours, CountsWhatLooksTheSameElsewhere) {
  RgbPicture picture = plain(80, 60, kGrey);
  paint(picture, 5, 5, 30, 30, kOrange);
  paint(picture, 50, 40, 59, 49, kOrange);
  const TrainingBox box{8, 8, 10, 10, 1};
  EXPECT_EQ(train_colours(picture, {&box, 1})[0].elsewhere, 100U);
}

TEST(TrainColours, ABlackBoxHasNoColour) {
  const RgbPicture picture = plain(20, 20, {3, 3, 3});
  const TrainingBox box{5, 5, 5, 5, 1};
  const TrainedColour black = train_colours(picture, {&box, 1})[0];
  EXPECT_DOUBLE_EQ(black.found, 0);
  EXPECT_EQ(black.elsewhere, 0U);
}

}  // namespace
}  // namespace fencepost::host
