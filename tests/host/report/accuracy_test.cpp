#include "host/report/accuracy.hpp"

#include <gtest/gtest.h>

#include "tests/host/report/scenes.hpp"

namespace fencepost::host {
namespace {

using testing::outline_model;

LinearRing box(double x, double y, double width, double height) {
  return {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
}

ObjectResult found(std::uint32_t id, std::uint8_t signature, Point centre, LinearRing clip) {
  ObjectResult object{id, signature, record::ObjectState::kConfirmed, 9, 0, 0.2, 0.9, {}};
  ModelResult cylinder;
  cylinder.name = "cylinder";
  cylinder.circle = Circle{centre, 0.5};
  object.models = {cylinder, outline_model("clip", std::move(clip))};
  return object;
}

Scene scene_of(const std::vector<std::pair<std::uint8_t, LinearRing>>& objects) {
  Scene scene;
  for (const auto& [signature, ring] : objects) scene.objects.push_back({"o", signature, 0, 1, {ring, {}}});
  return scene;
}

// Footprint 2 x 2 = 4 m^2, model 4 x 1 shifted so that they share 1 x 1 = 1 m^2. Recklessness is 1 - 1/4 = 0.75,
// paranoia 1 - 1/4 = 0.75 for a model of 4 m^2.
TEST(Accuracy, CountsSharesOfArea) {
  ResultDocument d;
  d.objects = {found(1, 1, {1.3, 1.4}, box(1, 1, 4, 1))};
  const auto all = measure_accuracy(d, scene_of({{1, box(0, 0, 2, 2)}}));
  ASSERT_EQ(all.size(), 1U);
  ASSERT_EQ(all[0].models.size(), 2U);
  EXPECT_NEAR(all[0].models[1].score.recklessness, 0.75, 1e-12);
  EXPECT_NEAR(all[0].models[1].score.paranoia, 0.75, 1e-12);
  EXPECT_NEAR(all[0].position_error.value(), 0.5, 1e-12);  // (0.3, 0.4) from the centroid (1, 1)
}

// Footprint 2 x 2 inside a model of 4 x 2: nothing missed, half of the model is free space.
TEST(Accuracy, TellsRecklessFromParanoid) {
  ResultDocument d;
  d.objects = {found(1, 1, {1, 1}, box(0, 0, 4, 2))};
  const auto all = measure_accuracy(d, scene_of({{1, box(0, 0, 2, 2)}}));
  EXPECT_NEAR(all.at(0).models[1].score.recklessness, 0, 1e-12);
  EXPECT_NEAR(all.at(0).models[1].score.paranoia, 0.5, 1e-12);
}

TEST(Accuracy, AModelWithoutAreaHasNoParanoia) {
  ResultDocument d;
  d.objects = {found(1, 1, {1, 1}, {})};
  d.objects[0].models[1].geometry.clear();
  const auto all = measure_accuracy(d, scene_of({{1, box(0, 0, 2, 2)}}));
  for (const ModelScore& model : all.at(0).models) {
    EXPECT_EQ(model.score.recklessness, 1);
    EXPECT_TRUE(model.score.empty);
  }
}

// The squares are 1 m wide, so 0.71 + 0.25 m are allowed. Truth 0 and 1 have signature 1, at 0 and at 1.2; truth 2 has
// signature 3: nobody's. Object 4 lies too far from all of them.
TEST(Accuracy, MatchesOneToOneWithinASignature) {
  ResultDocument d;
  d.objects = {found(1, 1, {0.5, 0}, box(0, 0, 1, 1)), found(2, 1, {0.1, 0}, box(0, 0, 1, 1)),
               found(3, 2, {0, 0}, box(0, 0, 1, 1)), found(4, 1, {3, 0}, box(0, 0, 1, 1))};
  const auto all = measure_accuracy(
      d, scene_of({{1, box(-0.5, -0.5, 1, 1)}, {1, box(0.7, -0.5, 1, 1)}, {3, box(-0.5, -0.5, 1, 1)}}));
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].id, 1U);
  EXPECT_EQ(all[0].truth, 1U);  // object 2 is nearer to truth 0 and takes it
  EXPECT_EQ(all[1].id, 2U);
  EXPECT_EQ(all[1].truth, 0U);
}

TEST(Accuracy, ATentativeObjectDoesNotTakeAnEstablishedOnesTruth) {
  ResultDocument d;
  d.objects = {found(1, 1, {0.4, 0}, box(0, 0, 1, 1)), found(2, 1, {0.1, 0}, box(0, 0, 1, 1))};
  d.objects[1].state = record::ObjectState::kTentative;
  const auto all = measure_accuracy(d, scene_of({{1, box(-0.5, -0.5, 1, 1)}}));
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].id, 1U);
}

}  // namespace
}  // namespace fencepost::host
