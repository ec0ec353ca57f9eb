// The real recordings, where they lie beside the checkout: imported bearings must triangulate the surveyed landmarks.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>
#include <numbers>

#include "host/import/import.hpp"
#include "tests/host/import/files.hpp"

namespace fencepost::host {
namespace {

struct Sightline {
  Point from;
  double bearing = 0;  ///< map frame
};

/// Robust least squares of sightlines: weights fall off with the angular miss (Cauchy, 1 degree).
Point triangulate(const std::vector<Sightline>& lines, Point guess) {
  constexpr double kScale = std::numbers::pi / 180;
  for (int pass = 0; pass < 30; ++pass) {
    double a11 = 0, a12 = 0, a22 = 0, b1 = 0, b2 = 0;
    for (const Sightline& line : lines) {
      const double dx = guess.x - line.from.x;
      const double dy = guess.y - line.from.y;
      const double miss = std::remainder(std::atan2(dy, dx) - line.bearing, 2 * std::numbers::pi);
      const double range2 = std::max(0.01, dx * dx + dy * dy);
      const double weight = 1 / (range2 * (1 + miss * miss / (kScale * kScale)));
      const double nx = -std::sin(line.bearing);
      const double ny = std::cos(line.bearing);
      const double h = nx * line.from.x + ny * line.from.y;
      a11 += weight * nx * nx, a12 += weight * nx * ny, a22 += weight * ny * ny;
      b1 += weight * nx * h, b2 += weight * ny * h;
    }
    const double det = a11 * a22 - a12 * a12;
    guess = {(a22 * b1 - a12 * b2) / det, (a11 * b2 - a12 * b1) / det};
  }
  return guess;
}

std::map<int, std::vector<Sightline>> sightlines_of(const Recorded& log) {
  std::map<int, std::vector<Sightline>> lines;
  std::size_t k = 0;
  for (const auto& frame : log.frames) {
    while (k + 1 < log.odometry.size() && log.odometry[k + 1].t < frame.t) ++k;
    if (k + 1 == log.odometry.size()) break;
    const auto& a = log.odometry[k];
    const auto& b = log.odometry[k + 1];
    const double share = static_cast<double>((frame.t - a.t).raw) / static_cast<double>((b.t - a.t).raw);
    const double turn = std::remainder(b.heading.to_double() - a.heading.to_double(), 2 * std::numbers::pi);
    const Point from{a.x.to_double() + share * (b.x - a.x).to_double(),
                     a.y.to_double() + share * (b.y - a.y).to_double()};
    for (const auto& blob : frame.blobs) {
      const auto bearing = [&](double u) {
        return std::atan((log.cameras[0].cx.to_double() - u) / log.cameras[0].fx.to_double());
      };
      const double middle = (bearing(blob.x1 - 0.5) + bearing(blob.x2 + 0.5)) / 2;
      lines[blob.signature].push_back({from, a.heading.to_double() + share * turn + middle});
    }
  }
  return lines;
}

class MrclamData : public testing::TestWithParam<const char*> {};

TEST_P(MrclamData, TriangulatesTheSurveyedLandmarks) {
  const std::string folder = std::string(FENCEPOST_SHARED_DIR) + "/data/mrclam/" + GetParam();
  if (!std::filesystem::exists(folder)) {
    std::cerr << "\n*** SKIPPED: no MRCLAM data beside the checkout; nothing was compared ***\n";
    GTEST_SKIP() << "data/mrclam is not there";
  }
  const ImportResult result = import_mrclam(folder, {});
  const Recorded log = recorded(result);
  EXPECT_GT(log.frames.size(), 2000U);
  auto lines = sightlines_of(log);
  std::vector<double> errors;
  for (const SceneObject& landmark : result->truth->objects) {
    Point centre{};
    for (const Point p : landmark.footprint.outer) centre = {centre.x + p.x / 256, centre.y + p.y / 256};
    ASSERT_GT(lines[landmark.signature].size(), 20U) << landmark.name;
    const Point found = triangulate(lines[landmark.signature], centre);
    errors.push_back(std::hypot(found.x - centre.x, found.y - centre.y));
  }
  ASSERT_EQ(errors.size(), 15U);
  std::sort(errors.begin(), errors.end());
  // Par of the data: median 23-24 mm, worst 74-79 mm.
  std::cout << GetParam() << ": median " << errors[7] << " m, worst " << errors[14] << " m\n";
  EXPECT_LT(errors[7], 0.030);
  EXPECT_LT(errors[14], 0.090);
}

INSTANTIATE_TEST_SUITE_P(Recordings, MrclamData, testing::Values("D6_R2", "D7_R2"));

}  // namespace
}  // namespace fencepost::host
