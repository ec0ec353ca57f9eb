#include "host/paper/history.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "host/evaluate/metrics.hpp"
#include "host/geometry/planar.hpp"
#include "host/paper/algorithm.hpp"
#include "host/paper/blocks_world.hpp"

namespace fencepost::host {
namespace {

const Tour& ideal_tour() {
  static const Tour tour = drive(blocks_world(BlocksWorld::kFigures, 4, false));
  return tour;
}

const ModelResult& model(const Snapshot& snapshot, std::string_view name) {
  return *std::find_if(snapshot.models.begin(), snapshot.models.end(), [&](const auto& m) { return m.name == name; });
}

TEST(FollowGiven, HasASnapshotForEachNumberOfFrames) {
  const History history = follow_given(ideal_tour(), kYellowLandmark, {1, 10, 75});
  ASSERT_EQ(history.snapshots.size(), 3U);
  EXPECT_EQ(history.snapshots[1].frames, 10U);
  EXPECT_EQ(history.snapshots[1].taken, history.snapshots[1].views);
  EXPECT_EQ(history.snapshots[2].taken, history.blobs.size());
  EXPECT_GT(history.snapshots[2].views, 60U);
}

TEST(FollowGiven, ReconstructsARoundBlock) {
  // Seed 4: the yellow block is a circle; without noise the cylinder is right but for whole pixels.
  const SceneObject& block = ideal_tour().scene.objects[kYellowLandmark];
  const History history = follow_given(ideal_tour(), kYellowLandmark, {75});
  const ModelResult& cylinder = model(history.snapshots[0], "cylinder");
  const double radius = std::sqrt(area(block.footprint) / 3.14159265358979);
  ASSERT_TRUE(cylinder.circle.has_value());
  EXPECT_NEAR(cylinder.circle->radius, radius, 0.002);
  EXPECT_NEAR(cylinder.circle->center.x, centroid(block.footprint).x, 0.002);
  EXPECT_NEAR(cylinder.circle->center.y, centroid(block.footprint).y, 0.002);
}

TEST(SolidOfModel, HasTheBlocksHeightAndColour) {
  const SceneObject& block = ideal_tour().scene.objects[kYellowLandmark];
  const History history = follow_given(ideal_tour(), kYellowLandmark, {75});
  for (const std::string_view name : {"cylinder", "cylinder_paper", "clip"}) {
    const Solid solid = solid_of_model(ideal_tour(), history, history.snapshots[0], name, kYellowLandmark);
    ASSERT_FALSE(solid.footprint.empty());
    EXPECT_NEAR(solid.z_min, 0, 0.01) << name;
    EXPECT_NEAR(solid.z_max, block.height_m, 0.01) << name;
    EXPECT_NEAR(solid.colour.red, 210, 6);  // a sigma of 12 over 75 views
    EXPECT_NEAR(solid.colour.green, 190, 6);
    EXPECT_EQ(solid.signature, 2);
  }
}

TEST(SolidOfModel, IsNothingOfAModelWithNothingToSay) {
  const History history = follow_given(ideal_tour(), kYellowLandmark, {1});
  EXPECT_TRUE(solid_of_model(ideal_tour(), history, history.snapshots[0], "sheaf", kYellowLandmark).footprint.empty());
  EXPECT_TRUE(solid_of_model(ideal_tour(), history, history.snapshots[0], "no such model", 1).footprint.empty());
}

TEST(FollowInferred, FindsTheSameBlocksInTheLogAlone) {
  const std::vector<History> histories = follow_inferred(ideal_tour(), {20, 75});
  ASSERT_EQ(histories.size(), ideal_tour().scene.objects.size());
  for (const std::size_t landmark : {kRedLandmark, kYellowLandmark}) {
    ASSERT_EQ(histories[landmark].snapshots.size(), 2U);
    const Polygon& footprint = ideal_tour().scene.objects[landmark].footprint;
    const ModelResult& cylinder = model(histories[landmark].snapshots[1], "cylinder");
    ASSERT_TRUE(cylinder.circle.has_value());
    EXPECT_NEAR(cylinder.circle->center.x, centroid(footprint).x, 0.015) << landmark;
    EXPECT_NEAR(cylinder.circle->center.y, centroid(footprint).y, 0.015) << landmark;
    EXPECT_LT(histories[landmark].snapshots[0].views, histories[landmark].snapshots[1].views);
    EXPECT_EQ(histories[landmark].snapshots[1].taken, histories[landmark].blobs.size());
  }
}

TEST(FollowInferred, GivesTheEndAloneAsItGivesItAmongOthers) {
  const std::vector<History> end = follow_inferred(ideal_tour(), {75});
  const std::vector<History> both = follow_inferred(ideal_tour(), {20, 75});
  const MultiPolygon& a = model(end[kRedLandmark].snapshots[0], "clip").geometry;
  const MultiPolygon& b = model(both[kRedLandmark].snapshots[1], "clip").geometry;
  ASSERT_FALSE(a.empty());
  EXPECT_EQ(a[0].outer, b[0].outer);
}

TEST(Algorithms, BeginWithThePapersThree) {
  ASSERT_GE(algorithms().size(), 4U);
  EXPECT_EQ(algorithms()[0].key, "cylinder");
  EXPECT_EQ(algorithms()[1].key, "sheaf");
  EXPECT_EQ(algorithms()[2].key, "carving");
  for (std::size_t a = 0; a < 3; ++a) {
    // The average is of two landmarks seen in as many images.
    const double average = (*algorithms()[a].paper_red + *algorithms()[a].paper_yellow) / 2;
    EXPECT_NEAR(average, *algorithms()[a].paper_average, 0.0051);
    EXPECT_FALSE(algorithms()[a].inferred);
  }
  EXPECT_FALSE(algorithm_index("no such algorithm").has_value());
}

}  // namespace
}  // namespace fencepost::host
