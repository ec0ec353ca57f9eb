#include "host/segment/appearance.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace fencepost::host {
namespace {

double apart(sensor::Rgb a, sensor::Rgb b) { return std::sqrt(squared_distance(appearance(a), appearance(b))); }

TEST(Appearance, HueHasNoSeamAtRed) {
  // 355 and 5 degrees: the blue and the green part of red swap.
  EXPECT_LT(apart({200, 30, 44}, {200, 44, 30}), kSameColour);
  EXPECT_LT(apart({200, 20, 26}, {200, 26, 20}), kSameColour / 2);
}

TEST(Appearance, PaintIsItselfInHalfTheLight) {
  EXPECT_LT(apart({200, 30, 30}, {100, 15, 15}), kSameColour);
  EXPECT_LT(apart({215, 180, 20}, {107, 90, 10}), kSameColour);
  EXPECT_LT(apart({30, 60, 170}, {15, 30, 85}), kSameColour);
}

TEST(Appearance, PaintsGreysAndWoodDiffer) {
  const sensor::Rgb red{200, 30, 30}, orange{220, 110, 20}, yellow{215, 180, 20}, green{25, 130, 60}, blue{30, 60, 170};
  const sensor::Rgb wood{200, 184, 163}, wall{190, 188, 180}, black{15, 15, 15}, grey{128, 128, 128},
      white{250, 250, 250};
  const sensor::Rgb all[] = {red, orange, yellow, green, blue, wood, black, grey, white};
  for (const sensor::Rgb& a : all) {
    for (const sensor::Rgb& b : all) {
      if (&a != &b) {
        EXPECT_GT(apart(a, b), kSameColour) << int{a.red} << " " << int{b.red};
      }
    }
  }
  EXPECT_GT(apart(wood, wall), kSameColour);
}

TEST(Appearance, BlackHasNoHue) {
  EXPECT_EQ(squared_distance(appearance({0, 0, 0}), {}), 0);
  // One grey level of noise in the dark is strong saturation on paper.
  EXPECT_LT(apart({3, 1, 1}, {1, 1, 3}), kSameColour);
}

TEST(ColourName, IsWhatPeopleSay) {
  EXPECT_EQ(colour_name({200, 30, 30}), "red");
  EXPECT_EQ(colour_name({90, 10, 14}), "red");
  EXPECT_EQ(colour_name({215, 180, 20}), "yellow");
  EXPECT_EQ(colour_name({25, 130, 60}), "green");
  EXPECT_EQ(colour_name({30, 60, 170}), "blue");
  EXPECT_EQ(colour_name({220, 110, 20}), "orange");
  EXPECT_EQ(colour_name({20, 20, 20}), "black");
  EXPECT_EQ(colour_name({128, 130, 128}), "grey");
  EXPECT_EQ(colour_name({250, 250, 250}), "white");
}

}  // namespace
}  // namespace fencepost::host
