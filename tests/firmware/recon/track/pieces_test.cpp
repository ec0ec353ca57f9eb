#include "firmware/recon/track/pieces.hpp"

#include <gtest/gtest.h>

#include <array>

#include "firmware/recon/observe/occlusion.hpp"

namespace fencepost::test {
namespace {

using recon::Observation;
using recon::PiecePair;
using recon::Prediction;
using recon::WaitingBlob;

// 316 x 208 px: columns of the image are those of the level camera, and no blob below is near the border.
recon::CameraModel camera() {
  recon::CameraModel model;
  model.fx = model.fy = 273.6F;
  model.cx = 157.5F;
  model.cy = 103.5F;
  model.width = 316;
  model.rows = 208;
  return model;
}

// Blobs and what is observed of them.
struct Frame {
  explicit Frame(std::initializer_list<WaitingBlob> list) {
    for (const WaitingBlob& blob : list) EXPECT_TRUE(blobs.push_back(blob));
    recon::observe(blobs.view(), camera(), observations);
  }
  [[nodiscard]] PiecePair find(std::span<const Prediction> predictions) const {
    return recon::find_pieces(observations.view(), predictions);
  }

  base::FixedVector<WaitingBlob, sensor::kMaxBlobs> blobs;
  recon::Observations observations;
};

// An object of signature 1 that is expected between these columns, 1 m away.
Prediction expected(std::int16_t left, std::int16_t right) {
  Prediction prediction;
  prediction.signature = 1;
  prediction.left = {left, 3};
  prediction.right = {right, 3};
  prediction.left_tolerance = prediction.right_tolerance = 25;
  prediction.depth = 1;
  prediction.possible = true;
  return prediction;
}

TEST(Pieces, BehindAPostAreJoined) {
  Frame frame{{{100, 80, 120, 120}, 1}, {{136, 81, 150, 119}, 1}, {{121, 60, 135, 170}, 2}};
  const PiecePair pair = frame.find({});
  ASSERT_TRUE(pair.found);
  EXPECT_EQ(pair.whole, recon::kNoMatch);
  recon::join(frame.blobs, pair);
  ASSERT_EQ(frame.blobs.size(), 2U);
  EXPECT_EQ(frame.blobs[0].box.x1, 100);
  EXPECT_EQ(frame.blobs[0].box.x2, 150);
  EXPECT_EQ(frame.blobs[0].box.y1, 80);
  EXPECT_EQ(frame.blobs[0].box.y2, 120);
  recon::observe(frame.blobs.view(), camera(), frame.observations);
  EXPECT_TRUE(is_edge(frame.observations[0].left));
  EXPECT_TRUE(is_edge(frame.observations[0].right));
}

TEST(Pieces, WithNothingBetweenStayTwo) {
  for (const WaitingBlob& other : {WaitingBlob{{121, 60, 128, 170}, 2},      // does not fill the gap
                                   WaitingBlob{{121, 60, 135, 100}, 2},      // ends above them: it stands farther away
                                   WaitingBlob{{121, 100, 135, 170}, 2}}) {  // lower: both would show above it
    const Frame frame{{{100, 80, 120, 120}, 1}, {{140, 81, 160, 119}, 1}, other};
    EXPECT_FALSE(frame.find({}).found);
  }
}

TEST(Pieces, ALostMiddleIsKnownByTheObjectThatWasExpected) {
  const Frame frame{{{100, 80, 115, 120}, 1}, {{136, 81, 150, 119}, 1}};
  EXPECT_FALSE(frame.find({}).found);
  const std::array<Prediction, 2> predictions{Prediction{}, expected(101, 149)};
  const PiecePair pair = frame.find(predictions);
  ASSERT_TRUE(pair.found);
  EXPECT_EQ(pair.whole, 1);
  EXPECT_TRUE(pair.rows_match);
}

TEST(Pieces, RowsThatDifferAreReported) {
  const Frame frame{{{100, 80, 115, 120}, 1}, {{136, 81, 150, 128}, 1}};
  const std::array<Prediction, 1> predictions{expected(101, 149)};
  const PiecePair pair = frame.find(predictions);
  ASSERT_TRUE(pair.found);
  EXPECT_FALSE(pair.rows_match);
}

TEST(Pieces, AnObjectBesideTheExpectedOneIsNoPieceOfIt) {
  const Frame frame{{{100, 80, 115, 120}, 1}, {{136, 81, 150, 119}, 1}};
  const std::array<Prediction, 1> left_only{expected(99, 116)};
  EXPECT_FALSE(frame.find(left_only).found);
  const std::array<Prediction, 2> one_each{expected(99, 149), expected(135, 151)};
  EXPECT_FALSE(frame.find(one_each).found);
}

TEST(Pieces, OfAnotherSignatureAreAnotherObjects) {
  const Frame frame{{{100, 80, 115, 120}, 1}, {{136, 81, 150, 119}, 3}};
  const std::array<Prediction, 1> predictions{expected(101, 149)};
  EXPECT_FALSE(frame.find(predictions).found);
}

// --- one blob of two objects ---

// Both ends and both rows seen.
Observation blob(std::int16_t left, std::int16_t right) {
  Observation seen;
  seen.box = {left, 80, right, 120};
  seen.signature = 1;
  seen.left = seen.right = seen.top = seen.bottom = recon::End::kSeen;
  seen.left_column = left;
  seen.right_column = right;
  return seen;
}

TEST(ShowsBoth, TwoThatTouchInTheImage) {
  EXPECT_TRUE(recon::shows_both(expected(101, 125), expected(126, 149), blob(100, 150)));
}

TEST(ShowsBoth, NotInTheOtherOrder) {
  EXPECT_FALSE(recon::shows_both(expected(126, 149), expected(101, 125), blob(100, 150)));
}

TEST(ShowsBoth, NotWhereOneAloneIsSoWide) {
  EXPECT_FALSE(recon::shows_both(expected(101, 145), expected(126, 149), blob(100, 150)));
  EXPECT_FALSE(recon::shows_both(expected(101, 125), expected(105, 149), blob(100, 150)));
}

TEST(ShowsBoth, NotWhereAnOuterEndIsElsewhere) {
  EXPECT_FALSE(recon::shows_both(expected(115, 130), expected(131, 149), blob(100, 150)));
  EXPECT_FALSE(recon::shows_both(expected(101, 120), expected(121, 135), blob(100, 150)));
}

TEST(ShowsBoth, NotAcrossAGap) {
  EXPECT_FALSE(recon::shows_both(expected(90, 101), expected(149, 160), blob(91, 159)));
}

TEST(ShowsBoth, TheFootIsThatOfTheNearerOne) {
  Prediction near = expected(101, 125);
  near.bottom = {120, 3};
  Prediction far = expected(126, 149);
  far.depth = 2;
  far.bottom = {95, 3};
  EXPECT_TRUE(recon::shows_both(near, far, blob(100, 150)));
  near.bottom = {140, 3};
  EXPECT_FALSE(recon::shows_both(near, far, blob(100, 150)));
}

// --- ends that a model hides ---

Prediction confirmed(std::int16_t left, std::int16_t right, float depth) {
  Prediction prediction = expected(left, right);
  prediction.confirmed = true;
  prediction.depth = depth;
  return prediction;
}

TEST(HidesEnd, OnlyANearerConfirmedObjectThatReachesTheEnd) {
  const Prediction behind = expected(80, 140);
  const Prediction post = confirmed(60, 101, 0.5F);
  EXPECT_TRUE(recon::hides_end(post, behind, 100, -1));
  EXPECT_FALSE(recon::hides_end(post, behind, 140, 1));
  EXPECT_FALSE(recon::hides_end(post, behind, 110, -1));
  EXPECT_FALSE(recon::hides_end(confirmed(60, 101, 0.99F), behind, 100, -1));
  Prediction tentative = post;
  tentative.confirmed = false;
  EXPECT_FALSE(recon::hides_end(tentative, behind, 100, -1));
}

// --- ends that contradict the model ---

TEST(CompareEnds, CountsFramesOffToOneSideAndForgetsOnAgreement) {
  recon::ObjectCore object;
  for (int i = 0; i < 3; ++i) recon::compare_ends(object, expected(100, 150), blob(101, 170));
  EXPECT_EQ(object.left_off, 0);
  EXPECT_EQ(object.right_off, 3);
  recon::compare_ends(object, expected(100, 150), blob(101, 130));
  EXPECT_EQ(object.right_off, -1);
  recon::compare_ends(object, expected(100, 150), blob(101, 151));
  EXPECT_EQ(object.right_off, 0);
}

TEST(CompareEnds, AWrongPoseContradictsNothing) {
  recon::ObjectCore object;
  for (int i = 0; i < 50; ++i) recon::compare_ends(object, expected(100, 150), blob(120, 170));
  EXPECT_FALSE(object.contradicted());
  for (int i = 0; i < 50; ++i) recon::compare_ends(object, expected(100, 150), blob(100, 170));
  EXPECT_TRUE(object.contradicted());
}

TEST(CompareEnds, AnOpenEndSeenAtLastContradictsNothing) {
  recon::ObjectCore object;
  const recon::EndsOff off = recon::ends_off(expected(100, 150), blob(100, 170), false);
  EXPECT_FALSE(off.left);
  EXPECT_TRUE(off.right);
  for (int i = 0; i < 50; ++i) recon::compare_ends(object, expected(100, 150), blob(100, 170), off);
  EXPECT_FALSE(object.contradicted());
}

TEST(CompareEnds, AnEndInsideIsOffOnlyWhereModelsGuess) {
  EXPECT_FALSE(recon::ends_off(expected(100, 150), blob(120, 150), false).left);
  EXPECT_TRUE(recon::ends_off(expected(100, 150), blob(120, 150), true).left);
}

TEST(CompareFoot, ThatOfWhatAStandingRobotSeesStaysWhereItIs) {
  recon::Observation near = blob(100, 150);
  near.box.y2 = 90;
  recon::Observation far = near;
  far.box.y2 = 60;
  recon::ObjectCore object;
  for (int i = 0; i < 20; ++i) recon::compare_foot(object, i % 2 == 1 ? near : far, false, 1);
  EXPECT_FALSE(object.contradicted()) << "the robot moves";
  recon::compare_foot(object, near, true, 1);
  for (int i = 0; i < 20; ++i) recon::compare_foot(object, i % 9 == 8 ? near : far, true, 1);
  EXPECT_FALSE(object.contradicted()) << "pieces were lost, and it was seen as it was";
  recon::compare_foot(object, near, true, 1);
  for (int i = 0; i < 9; ++i) recon::compare_foot(object, far, true, 1);
  EXPECT_FALSE(object.contradicted());
  recon::compare_foot(object, far, true, 1);
  EXPECT_TRUE(object.contradicted()) << "something else is there now";
}

TEST(StandsElsewhere, IsWhatHasAnotherFootAndIsNoPieceOfTheObject) {
  recon::Prediction object = expected(100, 150);
  object.top = {40, 2};
  object.foot_row = 120;
  const auto box = [](std::int16_t left, std::int16_t right, std::int16_t top, std::int16_t foot) {
    recon::Observation seen = blob(left, right);
    seen.top = seen.bottom = recon::End::kSeen;
    seen.box.y1 = top;
    seen.box.y2 = foot;
    return seen;
  };
  EXPECT_FALSE(recon::stands_elsewhere(object, box(100, 150, 40, 118))) << "the object itself";
  EXPECT_FALSE(recon::stands_elsewhere(object, box(100, 150, 70, 118))) << "its lower piece";
  EXPECT_FALSE(recon::stands_elsewhere(object, box(102, 140, 41, 90))) << "its upper piece";
  EXPECT_TRUE(recon::stands_elsewhere(object, box(102, 140, 60, 90))) << "another top";
  EXPECT_TRUE(recon::stands_elsewhere(object, box(20, 140, 41, 90))) << "it reaches too far";
  recon::Observation cut = box(20, 140, 60, 143);
  cut.bottom = recon::End::kLowerBound;
  EXPECT_FALSE(recon::stands_elsewhere(object, cut)) << "its foot was not seen";
  object.refuted = true;
  EXPECT_TRUE(recon::stands_elsewhere(object, box(102, 140, 41, 90))) << "the object was missing before";
  EXPECT_FALSE(recon::stands_elsewhere(object, box(100, 150, 40, 118)));
  object.foot_row = 0;
  EXPECT_FALSE(recon::stands_elsewhere(object, box(20, 140, 60, 90))) << "the robot has moved";
}

}  // namespace
}  // namespace fencepost::test
