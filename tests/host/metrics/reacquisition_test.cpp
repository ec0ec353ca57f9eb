#include "host/metrics/reacquisition.hpp"

#include <gtest/gtest.h>

namespace fencepost::host {
namespace {

/// 40 px by 20 px around (100, 60), full, red.
Region red_region() { return {80, 50, 120, 70, 800, 1, Colour{200, 40, 40}}; }

TEST(ReacquisitionTerms, AreZeroForTheSameRegion) {
  const ReacquisitionTerms terms = reacquisition_terms(red_region(), red_region(), 320);
  for (const NamedTerm& term : named_terms(terms)) EXPECT_EQ(term.value.value(), 0) << term.name;
  EXPECT_EQ(reacquisition_error(terms), 0);
}

TEST(ReacquisitionTerms, HueIsTheAngleOverSixtyDegreesForSaturatedColours) {
  Region orange = red_region();
  orange.colour = Colour{200, 120, 40};  // hue 30, saturation 0.8; red has hue 0, saturation 0.8
  const ReacquisitionTerms terms = reacquisition_terms(orange, red_region(), 320);
  EXPECT_NEAR(terms.hue, 0.5, 1e-12);
  EXPECT_NEAR(terms.rgb.value(), 80.0 / 160, 1e-12);
}

TEST(ReacquisitionTerms, HueGoesTheShortWayRound) {
  Region pink = red_region();
  pink.colour = Colour{200, 40, 72};  // hue 348: 12 from red, not 348
  EXPECT_NEAR(reacquisition_terms(pink, red_region(), 320).hue, 12.0 / 60, 1e-9);
}

TEST(ReacquisitionTerms, GreyIsToldFromRedBySaturation) {
  Region grey = red_region();
  grey.colour = Colour{100, 100, 100};
  // The lesser saturation is 0: only |0 - 0.8| / 0.5 counts, clipped.
  EXPECT_EQ(reacquisition_terms(grey, red_region(), 320).hue, 1);
  Region dull = red_region();
  dull.colour = Colour{120, 105, 105};  // saturation 0.125 = half of 0.25, hue 0: half the weight on |0.125 - 0| / 0.5
  EXPECT_NEAR(reacquisition_terms(dull, grey, 320).hue, 0.25, 1e-12);
}

TEST(ReacquisitionTerms, SizeIsALogarithmOfBaseFour) {
  Region larger = red_region();
  larger.left = 60;
  larger.right = 140;  // twice as wide
  larger.pixels = 1600;
  const ReacquisitionTerms terms = reacquisition_terms(larger, red_region(), 320);
  EXPECT_NEAR(terms.width, 0.5, 1e-12);
  EXPECT_EQ(terms.height, 0);
  EXPECT_NEAR(terms.shape, 0.25, 1e-12);  // half of the aspect's 0.5; both are full
  EXPECT_NEAR(reacquisition_terms(red_region(), larger, 320).width, 0.5, 1e-12);
}

TEST(ReacquisitionTerms, ShapeComparesHowFullTheBoxesAre) {
  Region thin = red_region();
  thin.pixels = 600;  // 0.75 of its box
  EXPECT_NEAR(reacquisition_terms(thin, red_region(), 320).shape, 0.25, 1e-12);
  Region unknown = red_region();
  unknown.pixels = 0;
  EXPECT_NEAR(reacquisition_terms(thin, unknown, 320).shape, 0.5 * (0.92 - 0.75) / 0.5, 1e-12);
  EXPECT_EQ(reacquisition_terms(unknown, thin, 320).shape, 0);  // nothing to compare: the aspect alone
}

TEST(ReacquisitionTerms, LocationIsAcrossAndDown) {
  Region beside = red_region();
  beside.left += 15;
  beside.right += 15;  // of half the rendered width + 10 = 30
  EXPECT_NEAR(reacquisition_terms(beside, red_region(), 320).location, 0.7 * 0.5, 1e-12);
  Region below = red_region();
  below.top += 20;
  below.bottom += 20;  // of 320 / 4 = 80
  EXPECT_NEAR(reacquisition_terms(below, red_region(), 320).location, 0.3 * 0.25, 1e-12);
}

TEST(ReacquisitionTerms, StayWithinOneHoweverFar) {
  const Region far{-1000, -1000, -999, -990, 1, 9, Colour{0, 255, 255}};
  for (const NamedTerm& term : named_terms(reacquisition_terms(far, red_region(), 320))) {
    EXPECT_GE(term.value.value(), 0) << term.name;
    EXPECT_LE(term.value.value(), 1) << term.name;
  }
  EXPECT_LE(reacquisition_error(reacquisition_terms(far, red_region(), 320)), 1);
}

TEST(ReacquisitionError, IsTheWeightedMean) {
  const ReacquisitionTerms terms{0.5, 0.25, 1, 0, 0.4, 0.2};
  // (0.32*0.5 + 0.22*0.25 + 0.11*1 + 0.10*0.4 + 0.25*0.2) / 1.11
  EXPECT_NEAR(reacquisition_error(terms), 0.415 / 1.11, 1e-12);
}

TEST(ReacquisitionError, LeavesOutWhatIsNotKnownAndNormalises) {
  ReacquisitionTerms terms{0.5, std::nullopt, 1, 0, 0.4, 0.2};
  EXPECT_NEAR(reacquisition_error(terms), 0.36 / 0.89, 1e-12);
  terms = {1, std::nullopt, 1, 1, 1, 1};
  EXPECT_NEAR(reacquisition_error(terms), 1, 1e-12);
}

TEST(ReacquisitionTerms, ComparesSignaturesWhereThereIsNoColour) {
  Region plain = red_region();
  plain.colour.reset();
  ReacquisitionTerms terms = reacquisition_terms(plain, red_region(), 320);
  EXPECT_EQ(terms.hue, 0);
  EXPECT_FALSE(terms.rgb.has_value());
  plain.signature = 2;
  EXPECT_EQ(reacquisition_terms(plain, red_region(), 320).hue, 1);
}

TEST(RegionOfBlob, HasContinuousEdges) {
  sensor::Blob blob;
  blob.x1 = 10;
  blob.x2 = 19;
  blob.y1 = 0;
  blob.y2 = 4;
  blob.pixels = 40;
  blob.signature = 7;
  const Region region = region_of(blob);
  EXPECT_EQ(region.left, 9.5);
  EXPECT_EQ(region.right, 19.5);
  EXPECT_EQ(region.width(), 10);
  EXPECT_EQ(region.height(), 5);
  EXPECT_NEAR(region.fill().value(), 0.8, 1e-12);
  EXPECT_EQ(region.signature, 7);
  EXPECT_FALSE(region.colour.has_value());
}

}  // namespace
}  // namespace fencepost::host
