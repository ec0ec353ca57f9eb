#include "firmware/recon/track/correspondence.hpp"

#include <gtest/gtest.h>

#include "firmware/recon/track/tuning.hpp"
#include "tests/firmware/recon/sweep.hpp"

namespace fencepost::test {
namespace {

using recon::End;
using recon::Observation;
using recon::PredictedLine;
using recon::Prediction;

End any_end(Draw& draw) { return draw.of({End::kSeen, End::kSeen, End::kAmbiguous, End::kLowerBound, End::kOccluded}); }

PredictedLine line_near(Draw& draw, int at, int off) {
  return {static_cast<std::int16_t>(draw.between(at - off, at + off)), draw.between<std::int16_t>(0, 3)};
}

/// An object some 20 columns wide at column 100, a foot at row 90.
Prediction any_prediction(Draw& draw, int left = 100, int right = 118, int off = 9) {
  Prediction prediction;
  prediction.left = line_near(draw, left, off);
  prediction.right = line_near(draw, right, off);
  prediction.top = line_near(draw, 50, 3);
  prediction.bottom = line_near(draw, 90, 3);
  prediction.left_tolerance = draw.between<std::int16_t>(1, 12);
  prediction.right_tolerance = draw.between<std::int16_t>(1, 12);
  prediction.foot_row = draw.of<std::int16_t>({0, 84, 90, 96, 97});
  prediction.refuted = draw.one_in(4);
  prediction.depth = draw.of({0.0F, recon::kSameDepth, 1.0F, 1.0F});
  prediction.hides = draw.coin();
  prediction.possible = !draw.one_in(8);
  return prediction;
}

Observation any_blob(Draw& draw, int left = 100, int right = 118, int off = 9) {
  Observation seen;
  seen.left = any_end(draw);
  seen.right = any_end(draw);
  seen.top = any_end(draw);
  seen.bottom = any_end(draw);
  seen.left_column = static_cast<std::int16_t>(draw.between(left - off, left + off));
  seen.right_column = static_cast<std::int16_t>(draw.between(right - off, right + off));
  seen.box = {seen.left_column, static_cast<std::int16_t>(draw.between(38, 62)), seen.right_column,
              static_cast<std::int16_t>(draw.between(80, 102))};
  return seen;
}

TEST(Correspondence, OfABlobAndAnObject) {
  Draw draw(1);
  Sweep sweep;
  for (int i = 0; i < 40'000; ++i) {
    const Prediction object = any_prediction(draw);
    Observation seen = any_blob(draw);
    sweep.tell("cost", recon::match_cost(object, seen));
    sweep.tell("impossible", recon::match_cost(object, seen) == recon::kImpossible);
    sweep.tell("covers", recon::covers(object, seen));
    sweep.tell("middle", recon::has_middle_of(object, seen));
    sweep.tell("overlaps", recon::overlaps(object, seen));
    sweep.tell("behind", recon::stands_behind(seen, object));
    sweep.tell("elsewhere", recon::stands_elsewhere(object, seen));
    const recon::EndsOff off = recon::ends_off(object, seen, draw.coin());
    sweep.tell("off", 2 * off.left + off.right);
    seen.bearing = true;
    sweep.tell("bearing", recon::match_cost(object, seen));
  }
  expect_said(sweep, {"cost 40000 48046496", "impossible 15235 800bd964", "covers 13699 33943427",
                      "middle 35473 05465b6a", "overlaps 34831 128d819e", "behind 6181 d243e029",
                      "elsewhere 7838 e99dbadb", "off 7190 0b98de4f", "bearing 40000 4eb52e35"});
}

// Most of the possible blobs lie within the tolerances, and cost little.
TEST(Correspondence, OfABlobThatIsAlmostTheObject) {
  Draw draw(2);
  Sweep sweep;
  for (int i = 0; i < 20'000; ++i) {
    Prediction object = any_prediction(draw, 100, 118, 2);
    object.possible = true;
    const Observation seen = any_blob(draw, 100, 118, 3);
    sweep.tell("cost", recon::match_cost(object, seen));
    object.depth = 0;  // somewhere between two columns
    object.right.at = static_cast<std::int16_t>(object.left.at + draw.between(-30, 30));
    Observation aside = seen;
    const int step = draw.between(-60, 60);
    aside.left_column = static_cast<std::int16_t>(aside.left_column + step);
    aside.right_column = static_cast<std::int16_t>(aside.right_column + step);
    sweep.tell("on its bearing", recon::match_cost(object, aside));
  }
  expect_said(sweep, {"cost 20000 ef284a85", "on its bearing 20000 41ceb7e7"});
}

TEST(Correspondence, CountsFramesInARowThatAreOffToOneSide) {
  Draw draw(3);
  Sweep sweep;
  for (int i = 0; i < 20'000; ++i) {
    recon::ObjectCore object;
    object.left_off = draw.of<std::int8_t>({-100, -99, -1, 0, 1, 99, 100});
    object.right_off = draw.of<std::int8_t>({-100, -99, -1, 0, 1, 99, 100});
    object.foot_row = draw.of<std::int16_t>({0, 1, 86, 90, 94});
    const Prediction prediction = any_prediction(draw);
    const Observation seen = any_blob(draw);
    recon::compare_ends(object, prediction, seen, {draw.one_in(4), draw.one_in(4)});
    const bool stands = draw.coin();
    sweep.tell("foot", recon::compare_foot(object, seen, stands));
    sweep.tell("left", object.left_off);
    sweep.tell("right", object.right_off);
    sweep.tell("row", object.foot_row);
  }
  expect_said(sweep, {"foot 2729 9964e362", "left 11474 46bd08eb", "right 11375 2e7609de", "row 20000 74a9c050"});
}

// One blob from the left end of one object to the right end of another one, which meet near column 118.
TEST(Correspondence, OfABlobThatMayBeTwoObjects) {
  Draw draw(4);
  Sweep sweep;
  for (int i = 0; i < 60'000; ++i) {
    Prediction left = any_prediction(draw, 100, 118, 3);
    Prediction right = any_prediction(draw, 118, 136, 3);
    if (draw.one_in(3)) left.left.at = draw.between<std::int16_t>(112, 124);  // of one without a distance: its bearing
    if (draw.one_in(3)) right.left.at = draw.between<std::int16_t>(112, 124);
    left.depth = draw.of({0.0F, 1.0F, 1.0F, 2.0F});
    right.depth = draw.of({0.0F, 1.0F, 1.0F, 2.0F});
    left.possible = right.possible = true;
    (draw.coin() ? left : right).possible = !draw.one_in(8);
    Observation seen = any_blob(draw, 100, 136, 3);
    seen.box.y2 = draw.between<std::int16_t>(82, 98);
    sweep.tell("both", recon::shows_both(left, right, seen));
  }
  expect_said(sweep, {"both 14885 ea2a0f31"});
}

TEST(Correspondence, OfANearerObjectBeforeAnEnd) {
  Draw draw(5);
  Sweep sweep;
  for (int i = 0; i < 20'000; ++i) {
    Prediction nearer = any_prediction(draw);
    nearer.depth = draw.of({0.0F, 0.5F, 0.5F, recon::kSameDepth, 1.0F});
    const Prediction behind = any_prediction(draw);
    const auto column = draw.between<std::int16_t>(85, 135);
    sweep.tell("hides left", recon::hides_end(nearer, behind, column, -1));
    sweep.tell("hides right", recon::hides_end(nearer, behind, column, 1));
  }
  expect_said(sweep, {"hides left 1211 7a7d323e", "hides right 1192 b66b0ef3"});
}

}  // namespace
}  // namespace fencepost::test
