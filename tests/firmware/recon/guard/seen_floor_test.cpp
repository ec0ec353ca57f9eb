#include "firmware/recon/guard/seen_floor.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/firmware/level_pixy2.hpp"
#include "tests/firmware/recon/guard/flat_world.hpp"

namespace fencepost::test {
namespace {

recon::MapPose floor_pose(double x, double y, double heading) {
  constexpr double kUnits = recon::kMapUnitsPerMetre;
  return {{static_cast<std::int32_t>(std::lround(x * kUnits)), static_cast<std::int32_t>(std::lround(y * kUnits))},
          static_cast<std::int32_t>(std::lround(1e6 * heading))};
}

// The image is 60 degrees wide; the lens is over the origin, 12 cm high: what is 6 cm high at least is seen from 0.16
// m.
struct FloorBench {
  void look(const std::vector<FlatFront>& world, double x = 0, double y = 0, double heading = 0) {
    show(flat_view(world, x, y, t, number), x, y, heading);
  }
  void show(const sensor::BlobFrame& frame, double x = 0, double y = 0, double heading = 0) {
    floor.look(recon::make_waiting(frame, 0), camera, floor_pose(x, y, heading));
    t += 0.2;
    ++number;
  }
  [[nodiscard]] bool seen(double x, double y) const {
    return floor.seen(static_cast<std::int32_t>(std::lround(1000 * x)),
                      static_cast<std::int32_t>(std::lround(1000 * y)));
  }

  recon::CameraModel camera = recon::make_camera_model(level_pixy2());
  recon::guard::SeenFloor floor;
  double t = 1;
  std::uint32_t number = 0;
};

TEST(SeenFloor, IsWhatTheImageShows) {
  FloorBench bench;
  EXPECT_FALSE(bench.seen(0.8, 0));
  bench.look({});
  for (double x = 0.3; x < 1.45; x += 0.05) {
    const double half = x * 0.5774 - 0.13;  // less a cell, and its corner that is nearest to the border
    for (double y = -half; y <= half; y += 0.02) EXPECT_TRUE(bench.seen(x, y)) << x << ", " << y;
    for (const double aside : {x * 0.5774 + 0.01, 1.0, 1.5}) {
      EXPECT_FALSE(bench.seen(x, aside)) << x << ", " << aside;
      EXPECT_FALSE(bench.seen(x, -aside)) << x << ", " << -aside;
    }
  }
  EXPECT_FALSE(bench.seen(0.05, 0)) << "below the image";
  EXPECT_FALSE(bench.seen(1.6, 0)) << "beyond the reach";
  EXPECT_FALSE(bench.seen(-0.5, 0)) << "behind";
}

TEST(SeenFloor, EndsAtAFootAndGoesOnBesideIt) {
  FloorBench bench;
  bench.look({{0.8, -0.1, 0.1}});
  EXPECT_TRUE(bench.seen(0.7, 0));
  for (const double x : {0.8, 1.0, 1.4}) EXPECT_FALSE(bench.seen(x, 0)) << x;
  EXPECT_TRUE(bench.seen(1.0, 0.3));
  EXPECT_FALSE(bench.seen(1.3, 0.15)) << "its shadow grows";
}

TEST(SeenFloor, StaysKnownForAWhileAndNoLonger) {
  FloorBench bench;
  bench.look({});
  ASSERT_TRUE(bench.seen(1.0, 0));
  for (int i = 0; i < 20; ++i) bench.look({}, 0, 0, 3.1416);  // 4 s, the other way
  EXPECT_TRUE(bench.seen(1.0, 0));
  EXPECT_TRUE(bench.seen(-1.0, 0));
  for (int i = 0; i < 35; ++i) bench.look({}, 0, 0, 3.1416);
  EXPECT_FALSE(bench.seen(1.0, 0)) << "11 s ago";
  EXPECT_TRUE(bench.seen(-1.0, 0));
}

TEST(SeenFloor, IsForgottenAfterAPause) {
  FloorBench bench;
  bench.look({});
  bench.t += 60;
  bench.look({}, 0, 0, 3.1416);
  EXPECT_FALSE(bench.seen(1.0, 0));
}

// 4 m to a side, and the robot in the middle: what it leaves behind is not mistaken for what comes.
TEST(SeenFloor, GoesWithTheRobotInEachDirection) {
  for (const auto& [dx, dy] : {std::pair{1.0, 0.0}, {-1.0, 0.0}, {0.0, 1.0}, {0.0, -1.0}, {0.7, -0.7}}) {
    const double heading = std::atan2(dy, dx);
    FloorBench bench;
    for (int step = 0; step <= 100; ++step) {
      const double x = 20 * dx + 0.05 * step * dx;  // 5 m, from anywhere
      const double y = 20 * dy + 0.05 * step * dy;
      bench.look({{100, 0, 0.01}}, x, y, heading);
      EXPECT_TRUE(bench.seen(x + 1.0 * dx, y + 1.0 * dy));
      if (step < 30) continue;
      EXPECT_TRUE(bench.seen(x - 0.5 * dx, y - 0.5 * dy)) << "driven past " << step;
      for (double ahead = 1.6; ahead < 1.9; ahead += 0.02) {
        EXPECT_FALSE(bench.seen(x + ahead * dx, y + ahead * dy)) << step << ", " << ahead;
      }
    }
  }
}

TEST(SeenFloor, NothingIsKnownWithoutPitchOrWithATableThatIsFull) {
  FloorBench bench;
  sensor::CameraIntrinsics camera = level_pixy2();
  camera.mount.pitch.reset();
  bench.camera = recon::make_camera_model(camera);
  bench.look({});
  EXPECT_FALSE(bench.seen(0.8, 0));

  FloorBench crowded;
  sensor::BlobFrame frame = flat_view({}, 0, 0, crowded.t, 0);
  for (std::int16_t i = 0; i < 16; ++i) {
    ASSERT_TRUE(frame.blobs.push_back({1, i, 10, static_cast<std::int16_t>(i + 3), 20, {}, {}, 0, std::nullopt}));
  }
  crowded.show(frame);
  EXPECT_FALSE(crowded.seen(0.8, 0)) << "the camera may have seen a seventeenth";
}

TEST(SeenFloor, ClearForgets) {
  FloorBench bench;
  bench.look({});
  bench.floor.clear();
  EXPECT_FALSE(bench.seen(0.8, 0));
  bench.t = 1;
  bench.look({}, 0, 0, 3.1416);
  EXPECT_FALSE(bench.seen(0.8, 0));
  EXPECT_TRUE(bench.seen(-0.8, 0));
}

}  // namespace
}  // namespace fencepost::test
