// The textbook filter is a fair reference: it finds landmarks where odometry alone is lost.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/real/alignment.hpp"
#include "tests/studies/drift/textbook_filter.hpp"

namespace fencepost::test {
namespace {

constexpr int kLaps = 4;
constexpr int kSteps = 60;  // a lap
const std::vector<host::Point> kLandmarks{{2.5, 0}, {-0.5, 2.5}, {-2, -1.5}, {0.2, 0.3}};

// Laps of 1 m radius, by odometry that turns `factor` times as much.
double map_error(double factor, bool corrects) {
  TextbookFilter filter;
  const double turn = 2 * std::numbers::pi / kSteps;
  const double forward = 2 * std::sin(turn / 2);
  double x = 1, y = 0, heading = std::numbers::pi / 2;
  for (int step = 0; step <= kLaps * kSteps; ++step) {
    for (std::size_t i = 0; i < kLandmarks.size(); ++i) {
      const double dx = kLandmarks[i].x - x, dy = kLandmarks[i].y - y;
      const double bearing = std::remainder(std::atan2(dy, dx) - heading, 2 * std::numbers::pi);
      const bool first = step >= kSteps * static_cast<int>(i);  // one more in each lap
      if (!first || (!corrects && step > kSteps * static_cast<int>(i))) continue;
      filter.see(static_cast<std::uint8_t>(i), bearing, std::hypot(dx, dy));
    }
    x += forward * std::cos(heading + turn / 2);
    y += forward * std::sin(heading + turn / 2);
    heading += turn;
    filter.move(forward * std::cos(turn / 2), forward * std::sin(turn / 2), factor * turn);
  }
  std::vector<Pair> pairs;
  for (const auto& [signature, place] : filter.landmarks()) pairs.push_back({place, kLandmarks[signature]});
  EXPECT_EQ(pairs.size(), kLandmarks.size());
  return rms(align(pairs).errors);
}

TEST(TextbookFilter, PlacesLandmarksExactlyByTrueOdometry) { EXPECT_LT(map_error(1, true), 1e-9); }

TEST(TextbookFilter, KnowsWhereOdometryIsLost) {
  EXPECT_GT(map_error(1.05, false), 0.3);
  EXPECT_LT(map_error(1.05, true), 0.05);
}

TEST(TextbookFilter, BearingsAloneBeginNothing) {
  TextbookFilter filter;
  filter.see(1, 0.5, {});
  EXPECT_TRUE(filter.landmarks().empty());
}

}  // namespace
}  // namespace fencepost::test
