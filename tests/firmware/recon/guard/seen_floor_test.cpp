#include "firmware/recon/guard/seen_floor.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/firmware/level_pixy2.hpp"
#include "tests/firmware/recon/guard/flat_world.hpp"
#include "tests/firmware/recon/sweep.hpp"

namespace fencepost::test {
namespace {

recon::MapPose floor_pose(double x, double y, double heading) {
  constexpr double kUnits = recon::kMapUnitsPerMetre;
  return {{static_cast<std::int32_t>(std::lround(x * kUnits)), static_cast<std::int32_t>(std::lround(y * kUnits))},
          static_cast<std::int32_t>(std::lround(1e6 * heading))};
}

// The image is 60 degrees wide, and the lens is 12 cm above the origin. Things at least 6 cm high are seen from 0.16 m.
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

// 4 m to a side, and the robot in the middle: the floor left behind is not mistaken for the floor ahead.
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

// Each cell of the floor, and rays across it, after blobs and poses on a coarse grid.
TEST(SeenFloor, OfEachCellAndRay) {
  Draw draw(51);
  Sweep sweep;
  for (int run = 0; run < 80; ++run) {
    FloorBench bench;
    if (run % 4 == 3) {
      sensor::CameraIntrinsics camera = level_pixy2();
      camera.mount.x = base::Metres::nearest(draw.of({0.128, 1.0, -1.0}));
      camera.mount.y = base::Metres::nearest(-0.064);
      camera.mount.z = base::Metres::nearest(draw.of({0.05, 0.06, 0.061, 0.3}));
      bench.camera = recon::make_camera_model(camera);
    }
    base::Time t{10'000};
    const std::int32_t unit = 6'400;  // a cell
    recon::MapPose pose{{draw.between(-900, 900) * unit, draw.between(-900, 900) * unit}, 0};
    for (int frame = 0; frame < 6; ++frame) {
      recon::WaitingFrame seen{t, static_cast<std::uint32_t>(frame), 0, {}};
      for (int i = draw.between(0, 2); i > 0; --i) {
        const auto x1 = draw.between<std::int16_t>(0, 300);
        ASSERT_TRUE(seen.blobs.push_back({{x1, 60, static_cast<std::int16_t>(std::min(315, x1 + draw.of({1, 20, 90}))),
                                           draw.of<std::int16_t>({207, 200, 160, 130, 122, 90})},
                                          1}));
      }
      bench.floor.look(seen, bench.camera, pose);
      const std::int32_t x = pose.position.x / 100, y = pose.position.y / 100;  // mm
      for (std::int32_t dx = -2'208; dx <= 2'208; dx += 64) {
        for (std::int32_t dy = -2'208; dy <= 2'208; dy += 64) sweep.tell("seen", bench.floor.seen(x + dx, y + dy));
      }
      for (int ray = 0; ray < 12; ++ray) {
        recon::FloorFrame from{x + draw.of({0, 0, 64, -192, 1'900, -2'000}), y + draw.of({0, 0, 64, 1'900, -2'000})};
        const auto [axis_x, axis_y] = draw.of<std::pair<int, int>>({{16'384, 0},
                                                                    {16'384, 0},
                                                                    {15'892, 3'988},
                                                                    {0, 16'384},
                                                                    {-16'384, 0},
                                                                    {0, -16'384},
                                                                    {11'585, 11'585},
                                                                    {9'830, -13'107}});
        from.axis_x = axis_x;
        from.axis_y = axis_y;
        const int first = draw.of({0, 64, 320, 320, 384, 448, 640, 640, 1'499, 1'500, 1'501});
        sweep.tell("along", bench.floor.seen_along(from, first, draw.of({32, 64})));
      }
      t = t + base::Duration{draw.of({1'999, 2'000, 2'001, 49'999, 50'000, 50'000, 99'999, 100'000, 2'000, 2'000})};
      pose.position.x += draw.of({0, 0, 1, -1, 20, -20, 31, 32, 33, 63, 64, 65, -64, -65}) * unit;
      pose.position.y += draw.of({0, 0, 1, -1, 20, -20, 31, 32, 33, 63, 64, 65, -64, -65}) * unit;
      if (draw.coin()) pose.heading = draw.of({0, 1'570'796, -1'570'796, 3'141'592, 400'000});
    }
  }
  expect_said(sweep, {"seen 106498 90d0e3aa", "along 416 3527de8d"});
}

TEST(FloorFrame, NearestWholeIsHalfAwayFromZeroAndKeptWithinItsLimit) {
  constexpr std::int32_t kUsual = 1 << 24;
  for (const auto& [value, whole] : {std::pair{0.0F, 0},
                                     {0.5F, 1},
                                     {-0.5F, -1},
                                     {0.49F, 0},
                                     {-1.5F, -2},
                                     {1.5F, 2},
                                     {3e7F, kUsual},
                                     {-3e7F, -kUsual}}) {
    EXPECT_EQ(recon::nearest_whole(value), whole) << value;
  }
  EXPECT_EQ(recon::nearest_whole(12.5F, 12), 12);
  EXPECT_EQ(recon::nearest_whole(-99, 12), -12);
}

}  // namespace
}  // namespace fencepost::test
