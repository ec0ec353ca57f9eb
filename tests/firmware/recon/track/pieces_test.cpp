#include "firmware/recon/track/pieces.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "firmware/recon/observe/occlusion.hpp"

#include "tests/firmware/recon/sweep.hpp"

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

TEST(Pieces, OfOneIdKeepIt) {
  for (const unsigned other : {5U, 6U}) {
    Frame frame{{{100, 80, 120, 120}, 1}, {{136, 81, 150, 119}, 1}, {{121, 60, 135, 170}, 2}};
    frame.blobs[0].track = 5;
    frame.blobs[1].track = static_cast<std::uint8_t>(other) & recon::kMaxTrack;
    recon::join(frame.blobs, frame.find({}));
    EXPECT_EQ(unsigned{frame.blobs[0].track}, other == 5 ? 5U : 0U);
  }
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
  prediction.hides = true;
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
  tentative.hides = false;
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
  recon::Observation cut = far;
  cut.bottom = recon::End::kLowerBound;
  recon::ObjectCore object;
  EXPECT_FALSE(recon::compare_foot(object, near, true)) << "the first";
  EXPECT_TRUE(recon::compare_foot(object, far, true));
  EXPECT_TRUE(recon::compare_foot(object, far, true)) << "nobody believed the last one";
  EXPECT_FALSE(recon::compare_foot(object, near, true));
  EXPECT_FALSE(recon::compare_foot(object, cut, true)) << "its foot may be lower";
  EXPECT_FALSE(recon::compare_foot(object, far, false)) << "the robot moves";
  EXPECT_TRUE(recon::compare_foot(object, near, true));
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

recon::End any_piece_end(Draw& draw) {
  return draw.of({recon::End::kSeen, recon::End::kSeen, recon::End::kAmbiguous, recon::End::kLowerBound});
}

/// Columns from near `left` to near `right`, rows from near 80 to near 120.
Observation any_piece(Draw& draw, int left, int right, std::uint8_t signature) {
  const auto near = [&](int at, int off) { return static_cast<std::int16_t>(draw.between(at - off, at + off)); };
  Observation seen;
  seen.signature = signature;
  seen.left = any_piece_end(draw);
  seen.right = any_piece_end(draw);
  seen.top = any_piece_end(draw);
  seen.bottom = any_piece_end(draw);
  seen.left_column = near(left, 4);
  seen.right_column = near(right, 4);
  seen.box = {seen.left_column, near(80, 4), seen.right_column, near(120, 4)};
  return seen;
}

// Two blobs with a gap, perhaps a post in it, and up to two objects that are expected about there.
TEST(Pieces, OfBlobsAndObjectsThatAreAlmostWhereTheyShouldBe) {
  Draw draw(11);
  Sweep sweep;
  for (int i = 0; i < 60'000; ++i) {
    std::vector<Observation> blobs{any_piece(draw, 100, 110, 1), any_piece(draw, 120, 130, draw.one_in(6) ? 2 : 1)};
    if (draw.coin()) {
      Observation post = any_piece(draw, 112, 118, draw.one_in(4) ? 1 : 2);
      post.box.y1 = static_cast<std::int16_t>(post.box.y1 + draw.of({0, -8}));
      post.box.y2 = static_cast<std::int16_t>(post.box.y2 + draw.of({0, 8}));
      blobs.push_back(post);
    }
    std::vector<Prediction> objects(static_cast<std::size_t>(draw.between(0, 2)));
    for (Prediction& object : objects) {
      const int kind = draw.between(0, 2);
      object = expected(kind == 2 ? 118 : 100, kind == 1 ? 112 : 130);
      object.left.at = static_cast<std::int16_t>(object.left.at + draw.between(-4, 4));
      object.right.at = static_cast<std::int16_t>(object.right.at + draw.between(-4, 4));
      object.left_tolerance = object.right_tolerance = draw.between<std::int16_t>(1, 8);
      object.left.sigma = draw.between<std::int16_t>(0, 2);
      object.right.sigma = draw.between<std::int16_t>(0, 2);
      if (draw.one_in(8)) object.depth = 0;
      if (draw.one_in(8)) object.signature = 2;
    }
    const PiecePair pair = recon::find_pieces(blobs, objects);
    sweep.tell("found", pair.found);
    sweep.tell("which", pair.found ? 4 * pair.left + pair.right : 0);
    sweep.tell("whole", pair.found && pair.whole != recon::kNoMatch ? pair.whole + 1 : 0);
    sweep.tell("rows", pair.found && pair.rows_match);
    sweep.tell("alike", recon::are_alike(blobs[0], blobs[1]));
  }
  expect_said(sweep, {"found 14145 a84dd8a9", "which 14145 e44811f3", "whole 4316 ee5a5cd5", "rows 12877 c0d20c17",
                      "alike 33825 46e5c6df"});
}

// As wide as both together is the widest gap between two that are alike.
TEST(Pieces, AreAlikeAtAnyDistanceUpToTheirWidths) {
  Draw draw(12);
  Sweep sweep;
  for (int i = 0; i < 20'000; ++i) {
    Observation one = any_piece(draw, 100, 108, 1);
    const int left = draw.between(104, 128);
    Observation other = any_piece(draw, left, 136, draw.one_in(8) ? 2 : 1);
    if (draw.coin()) std::swap(one, other);
    sweep.tell("alike", recon::are_alike(one, other));
  }
  expect_said(sweep, {"alike 8834 7ac2246c"});
}

TEST(Pieces, JoinedOneIsWhereBothAreAndMovesIfOneDoes) {
  for (const int moves : {0, 1, 2, 3}) {
    base::FixedVector<WaitingBlob, sensor::kMaxBlobs> blobs;
    ASSERT_TRUE(blobs.push_back({{10, 22, 20, 40}, 1, (moves & 1) != 0}));
    ASSERT_TRUE(blobs.push_back({{30, 20, 45, 39}, 1, (moves & 2) != 0}));
    recon::join(blobs, {0, 1, true});
    ASSERT_EQ(blobs.size(), 1U);
    EXPECT_EQ(blobs[0].moves, moves != 0);
    EXPECT_EQ(blobs[0].box.x1, 10);
    EXPECT_EQ(blobs[0].box.y1, 20);
    EXPECT_EQ(blobs[0].box.x2, 45);
    EXPECT_EQ(blobs[0].box.y2, 40);
  }
}

}  // namespace
}  // namespace fencepost::test
