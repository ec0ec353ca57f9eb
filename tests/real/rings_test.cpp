// A real calibrated ring of silhouettes, through our own stream: importer, loop, models.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "firmware/recon/models/clip.hpp"
#include "host/geometry/half_planes.hpp"
#include "host/geometry/planar.hpp"
#include "host/import/import.hpp"
#include "host/replay/replay.hpp"

namespace fencepost::test {
namespace {

const std::string kRings = FENCEPOST_SHARED_DIR "/data/rings/dinoSparseRing/bearings.csv";

// The bounding box that the data set's authors publish (its README), m.
struct Box {
  double x_low = 1e9, x_high = -1e9, y_low = 1e9, y_high = -1e9;
};
constexpr Box kPublished{-0.061897, 0.010897, -0.057845, 0.015495};
constexpr double kSideTolerance = 2.5e-3;

Box box_of(const host::MultiPolygon& areas) {
  Box box;
  for (const host::Polygon& polygon : areas) {
    for (const host::Point& p : polygon.outer) {
      box = {std::min(box.x_low, p.x), std::max(box.x_high, p.x), std::min(box.y_low, p.y), std::max(box.y_high, p.y)};
    }
  }
  return box;
}

void print(const char* what, const Box& box) {
  std::printf("  %-9s x %8.5f .. %8.5f   z %8.5f .. %8.5f m\n", what, box.x_low, box.x_high, box.y_low, box.y_high);
}

void expect_near(const Box& box, const Box& other, double tolerance) {
  EXPECT_NEAR(box.x_low, other.x_low, tolerance);
  EXPECT_NEAR(box.x_high, other.x_high, tolerance);
  EXPECT_NEAR(box.y_low, other.y_low, tolerance);
  EXPECT_NEAR(box.y_high, other.y_high, tolerance);
}

// The wedges straight from the file, in double; an end on the image border bounds nothing.
host::LinearRing exact_intersection() {
  std::ifstream file(kRings);
  std::string line;
  std::getline(file, line);
  host::LinearRing region = host::square({0, 0}, 2);
  while (std::getline(file, line)) {
    double frame = 0, x = 0, y = 0, heading = 0, low = 0, high = 0;
    int low_on_border = 0, high_on_border = 0, excluded = 0;
    const int read = std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf,%lf,%d,%d,%d", &frame, &x, &y, &heading, &low,
                                 &high, &low_on_border, &high_on_border, &excluded);
    if (read != 9) {
      ADD_FAILURE() << "cannot read " << line;
      return {};
    }
    if (excluded != 0) continue;
    const host::Wedge wedge{{x, y}, heading + low, heading + high};
    if (low_on_border == 0) region = host::clipped(region, host::right_bound(wedge));
    if (high_on_border == 0) region = host::clipped(region, host::left_bound(wedge));
  }
  return region;
}

TEST(Rings, ClipAndGridMatchTheExactIntersectionAndThePublishedBox) {
  if (!std::filesystem::exists(kRings)) GTEST_SKIP() << "NOT TESTED: " << kRings << " is not on this machine";
  const host::ImportResult imported = host::import_rings(kRings);
  ASSERT_TRUE(imported.ok());
  const host::MultiPolygon exact{{exact_intersection(), {}}};
  const Box exact_box = box_of(exact);
  print("published", kPublished);
  print("exact", exact_box);
  for (const char* profile : {"full", "small", "micro"}) {
    SCOPED_TRACE(profile);
    host::ReplayOptions options;
    options.profile = profile;
    const host::ReplayOutcome outcome = host::replay(imported->log, kRings, options);
    ASSERT_FALSE(outcome.unreadable.has_value()) << outcome.unreadable->message;
    ASSERT_EQ(outcome.result.objects.size(), 1U);
    EXPECT_EQ(outcome.result.objects[0].views, 15U);
    for (const host::ModelResult& model : outcome.result.objects[0].models) {
      SCOPED_TRACE(model.name);
      const bool plain = model.name == "clip_paper" || model.name == "carve_paper";
      if (model.name == "clip" || model.name == "carve" || model.name == "hybrid") {
        const Box box = box_of(model.geometry);
        print(model.name.c_str(), box);
        if (std::string(profile) == "full") expect_near(box, kPublished, 3e-3);
        continue;
      }
      if (!plain) continue;
      const auto apart = host::outline_distance(model.geometry, exact, 1e-4);
      ASSERT_TRUE(apart.has_value());
      const Box box = box_of(model.geometry);
      std::printf("  %s %s: outline %.3f mm from the exact intersection\n", profile, model.name.c_str(),
                  1e3 * apart->hausdorff());
      print(model.name.c_str(), box);
      EXPECT_LT(host::difference_area(exact, model.geometry), 1e-3 * host::area(exact));
      if (std::string(profile) != "full") continue;
      expect_near(box, kPublished, kSideTolerance);
      // The full grid spans the clip (76 mm) by 128 cells with at most 1/0.6 slack: 1.1 mm a cell at most. An uncarved
      // corner cell may stick out by its diagonal.
      EXPECT_LT(apart->hausdorff(), model.name == "clip_paper" ? 1e-3 : 1.1e-3 * 1.42);
    }
  }
}

}  // namespace
}  // namespace fencepost::test
