#include "host/evaluate/matching.hpp"

#include <gtest/gtest.h>

#include "tests/host/evaluate/shapes.hpp"

namespace fencepost::host {
namespace {

using testing::at;
using testing::box;
using testing::squares;
using Matches = std::vector<std::optional<std::size_t>>;

// The squares allow 0.0707 + 0.25 = 0.3207 m.
TEST(Matching, HasAGate) {
  const Scene truth = squares({{1, {0, 0}}});
  EXPECT_EQ(match_objects({at(1, 1, {0.32, 0})}, truth), (Matches{0}));
  EXPECT_EQ(match_objects({at(1, 1, {0.33, 0})}, truth), (Matches{std::nullopt}));
}

TEST(Matching, NeedsTheSameSignature) {
  EXPECT_EQ(match_objects({at(1, 2, {0, 0})}, squares({{1, {0, 0}}})), (Matches{std::nullopt}));
}

// Two red boxes 0.2 m apart at x = 0 and 0.2. Objects at 0.12 and 0.19: the nearest true box of both is the second.
// Together: 0.12 + 0.01 beats 0.19 + 0.08.
TEST(Matching, TwoOfOneColourAreSharedOutAsAWhole) {
  const Scene truth = squares({{1, {0, 0}}, {1, {0.2, 0}}});
  EXPECT_EQ(match_objects({at(1, 1, {0.12, 0}), at(2, 1, {0.19, 0})}, truth), (Matches{0, 1}));
  EXPECT_EQ(match_objects({at(1, 1, {0.19, 0}), at(2, 1, {0.12, 0})}, truth), (Matches{1, 0}));
}

// A ghost at x = -0.3 could mean only the first box. That would push the object that sits on it to the second, 0.29 m
// off. 0.3 + 0.29 of 0.32 each is more than leaving the ghost alone.
TEST(Matching, AGhostDoesNotPushAnObjectFromItsPlace) {
  const Scene truth = squares({{1, {0, 0}}, {1, {0.3, 0}}});
  EXPECT_EQ(match_objects({at(1, 1, {0.01, 0}), at(2, 1, {-0.3, 0})}, truth), (Matches{0, std::nullopt}));
}

TEST(Matching, ATentativeObjectDoesNotTakeAConfirmedOnesPlace) {
  std::vector<ObjectResult> objects{at(1, 1, {0, 0}), at(2, 1, {0.1, 0})};
  objects[0].state = record::ObjectState::kTentative;
  EXPECT_EQ(match_objects(objects, squares({{1, {0, 0}}})), (Matches{std::nullopt, 0}));
  objects[1].state = record::ObjectState::kLost;  // was confirmed, out of sight
  EXPECT_EQ(match_objects(objects, squares({{1, {0, 0}}})), (Matches{std::nullopt, 0}));
  objects[1].signature = 2;
  EXPECT_EQ(match_objects(objects, squares({{1, {0, 0}}})), (Matches{0, std::nullopt}));
}

TEST(Matching, WithoutACylinderTheLargestAreaTellsThePlace) {
  ObjectResult object = at(1, 1, {0, 0});
  object.models[0].circle.reset();
  EXPECT_EQ(place_of(object), std::nullopt);
  EXPECT_EQ(match_objects({object}, squares({{1, {0, 0}}})), (Matches{std::nullopt}));
  ModelResult clip;
  clip.name = "clip";
  clip.geometry = {box(5, 5, 0.1, 0.1), box(0, 0, 0.2, 0.2)};
  object.models.push_back(clip);
  EXPECT_NEAR(place_of(object)->x, 0.1, 1e-12);
  EXPECT_EQ(match_objects({object}, squares({{1, {0, 0}}})), (Matches{0}));
}

}  // namespace
}  // namespace fencepost::host
