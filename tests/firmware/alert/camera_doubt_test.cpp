#include "firmware/alert/camera_doubt.hpp"

#include <gtest/gtest.h>

#include "firmware/alert/alerts.hpp"
#include "tests/firmware/recon/exact_view.hpp"

namespace fencepost::test {
namespace {

using alert::CameraDoubt;
using alert::RowVotes;
using record::Doubt;

constexpr base::Time kNow{120'000};

RowVotes votes(unsigned too_far, unsigned too_near, unsigned right) {
  return {too_far, too_near, right, 0.75F * static_cast<float>(too_far), 1.5F * static_cast<float>(too_near)};
}

TEST(CameraDoubt, NothingIsSaidOfATrueCamera) {
  CameraDoubt doubt;
  EXPECT_FALSE(doubt.judge(votes(0, 0, 5), {}, kNow));
  EXPECT_FALSE(doubt.any());
  EXPECT_FALSE(doubt.spoke());
  EXPECT_EQ(doubt.caution(), 1);
}

TEST(CameraDoubt, OneOrTwoThingsOnBasesAreNoComplaint) {
  CameraDoubt doubt;
  EXPECT_FALSE(doubt.judge(votes(1, 0, 0), {}, kNow));
  EXPECT_FALSE(doubt.judge(votes(2, 0, 0), {}, kNow));
}

TEST(CameraDoubt, ThreeOfWhichMostAreWrongAlikeAre) {
  CameraDoubt doubt;
  EXPECT_FALSE(doubt.judge(votes(3, 0, 3), {}, kNow)) << "as many are right";
  EXPECT_FALSE(doubt.judge(votes(3, 3, 0), {}, kNow)) << "as many are wrong the other way";
  ASSERT_TRUE(doubt.judge(votes(3, 0, 2), {}, kNow));
  EXPECT_EQ(doubt.said(), (record::CalibrationDoubt{kNow, Doubt::kRows, {133}}));
  EXPECT_FLOAT_EQ(doubt.caution(), 1.33F);
  EXPECT_FALSE(doubt.judge(votes(4, 0, 2), {}, kNow)) << "said already";
}

TEST(CameraDoubt, ThingsFartherThanToldMakeNobodyBolder) {
  CameraDoubt doubt;
  ASSERT_TRUE(doubt.judge(votes(0, 3, 0), {}, kNow));
  EXPECT_EQ(doubt.said(), (record::CalibrationDoubt{kNow, Doubt::kRows, {67}}));
  EXPECT_EQ(doubt.caution(), 1);
}

TEST(CameraDoubt, AWrongLensIsSaidBeforeRows) {
  CameraDoubt doubt;
  ASSERT_TRUE(doubt.judge(votes(3, 0, 0), 1.45F, kNow));
  EXPECT_EQ(doubt.said(), (record::CalibrationDoubt{kNow, Doubt::kLens, {145}}));
  EXPECT_FALSE(doubt.judge(votes(3, 0, 0), 1.5F, kNow));
  ASSERT_TRUE(doubt.judge(votes(3, 0, 0), {}, {130'000}));
  EXPECT_EQ(doubt.said().doubt, Doubt::kRows);
}

TEST(CameraDoubt, LastsUntilMoreRowsAreRightThanWrong) {
  CameraDoubt doubt;
  ASSERT_TRUE(doubt.judge(votes(3, 0, 0), {}, kNow));
  EXPECT_FALSE(doubt.judge(votes(0, 0, 0), {}, kNow)) << "the map has forgotten them";
  EXPECT_FALSE(doubt.judge(votes(1, 0, 1), {}, kNow));
  EXPECT_TRUE(doubt.any());
  ASSERT_TRUE(doubt.judge(votes(1, 0, 2), {}, {130'000}));
  EXPECT_EQ(doubt.said(), (record::CalibrationDoubt{{130'000}, Doubt::kNone, {100}}));
  EXPECT_TRUE(doubt.spoke());
}

TEST(CameraDoubt, FactorsAreRoundedToHundredths) {
  for (const auto& [factor, raw] : {std::pair(1.3348F, 133), {1.3352F, 134}, {0.001F, 1}, {1'000.0F, 10'000}}) {
    CameraDoubt doubt;
    ASSERT_TRUE(doubt.judge(votes(0, 0, 0), factor, kNow));
    EXPECT_EQ(doubt.said().factor.raw, raw) << factor;
  }
}

TEST(CameraDoubt, ATenthMoreOrLessIsToldAnew) {
  for (const auto& [factor, told] : {std::pair(1.59F, false), {1.6F, true}, {1.41F, false}, {1.4F, true}}) {
    CameraDoubt doubt;
    ASSERT_TRUE(doubt.judge(votes(0, 0, 0), 1.5F, kNow));
    EXPECT_EQ(doubt.judge(votes(0, 0, 0), factor, kNow), told) << factor;
  }
}

// A quarter too far; too near by 1.45.
TEST(CameraDoubt, HowLargeAnErrorIsAComplaint) {
  const auto doubts = [](const RowVotes& seen) { return CameraDoubt{}.judge(seen, {}, kNow); };
  EXPECT_TRUE(doubts({5, 0, 0, 4.0F, 0})) << "1.25";
  EXPECT_FALSE(doubts({5, 0, 0, 4.02F, 0}));
  EXPECT_TRUE(doubts({0, 4, 0, 0, 5.81F}));
  EXPECT_FALSE(doubts({0, 4, 0, 0, 5.79F}));
  EXPECT_FALSE(doubts({3, 0, 0, 0, 0})) << "of no scale nothing follows";
}

TEST(CameraDoubt, AnotherCalibrationIsNotDoubted) {
  CameraDoubt doubt;
  EXPECT_FALSE(doubt.forget(kNow)) << "there was none";
  ASSERT_TRUE(doubt.judge(votes(3, 0, 0), {}, kNow));
  EXPECT_TRUE(doubt.forget(kNow));
  EXPECT_FALSE(doubt.any());
}

TEST(CameraDoubt, CautionHasALimit) {
  CameraDoubt doubt;
  ASSERT_TRUE(doubt.judge({3, 0, 0, 1.2F, 0}, {}, kNow));
  EXPECT_EQ(doubt.caution(), 2);
}

TEST(CameraDoubt, WidensDistancesAndNotTimes) {
  const config::Settings settings;
  const alert::AlertRules calm(settings);
  const alert::AlertRules careful(settings, 1.5F);
  EXPECT_FLOAT_EQ(careful.stop, 1.5F * calm.stop);
  EXPECT_FLOAT_EQ(careful.warn, 1.5F * calm.warn);
  EXPECT_FLOAT_EQ(careful.notice, 1.5F * calm.notice);
  EXPECT_EQ(careful.ttc_stop, calm.ttc_stop);
}

// An object on a base of 3 cm, met straight on by a lens 12 cm above the floor.
recon::ObjectCore on_base(recon::End left) {
  recon::ObjectCore object;
  object.id = 1;
  for (int i = 0; i < 60; ++i) {
    const host::Point lens{0.01 * i, 0};
    recon::Sighting sighting = view_of_circle({1.06, 0}, 0.06, lens).sighting;
    sighting.left.end = left;
    sighting.rows_known = true;
    sighting.bottom = {static_cast<float>(0.09 / (1.0 - lens.x)), recon::End::kSeen};
    object.cylinder.add(sighting, {0, 0}, 1, {});
    object.cylinder.solve(sighting.lens_from({0, 0}), sighting.center, {});
  }
  return object;
}

TEST(CameraDoubt, CountsConfirmedObjectsByTheirRows) {
  recon::ObjectCore object = on_base(recon::End::kSeen);
  RowVotes seen;
  seen.add(object);
  EXPECT_EQ(seen.too_far, 0U) << "not confirmed";
  object.confirmed = true;
  seen.add(object);
  EXPECT_EQ(seen.too_far, 1U);
  EXPECT_NEAR(seen.scales_too_far, 0.75F, 0.06F);
  object.cylinder.recalibrated();
  seen = {};
  seen.add(object);
  EXPECT_EQ(seen.too_far + seen.too_near + seen.right, 0U);
}

TEST(CameraDoubt, LeavesOutWhatWasNeverSeenWhole) {
  recon::ObjectCore object = on_base(recon::End::kLowerBound);
  object.confirmed = true;
  ASSERT_EQ(object.cylinder.row_trend().verdict(), recon::RowVerdict::kTooFar);
  RowVotes seen;
  seen.add(object);
  EXPECT_EQ(seen.too_far, 0U);
}

}  // namespace
}  // namespace fencepost::test
