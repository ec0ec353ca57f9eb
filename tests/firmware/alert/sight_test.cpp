// Whether the robot can know what is ahead, from its inputs' times and contents.
#include "firmware/alert/sight.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/firmware/level_pixy2.hpp"
#include "tests/firmware/recon/guard/flat_world.hpp"

namespace fencepost::test {
namespace {

using alert::Blindness;
using sensor::LinkState;

/// Frames at `rate` and odometry at 50 samples a second; what is turned off stays away.
class Inputs {
 public:
  explicit Inputs(double rate = 10) : rate_(rate) { sight.start(base::Time::nearest(0)); }

  void run(double seconds) {
    for (const double end = t + seconds - 1e-9; t < end;) {
      t += 0.02;
      x += 0.02 * speed;
      heading += 0.02 * turn;
      if (odometry_on) sight.odometry_came(sample());
      if (t - last_frame_ < 1 / rate_ - 1e-6) continue;
      last_frame_ = t;
      if (camera_on) sight.frame_came(now());
      if (camera_on && used) sight.frame_used(view(), camera, recon::to_map_pose(sample()));
    }
  }

  [[nodiscard]] base::Time now() const { return base::Time::nearest(t); }
  [[nodiscard]] bool standing() const { return speed == 0 && turn == 0; }
  [[nodiscard]] Blindness blindness() const { return sight.blindness(now(), standing()); }
  [[nodiscard]] LinkState camera_state() const { return sight.camera_state(now(), standing()); }
  [[nodiscard]] LinkState odometry_state() const { return sight.odometry_state(now(), standing()); }
  /// Seconds until it is blind for that reason; kNever if it does not become so.
  static constexpr double kNever = 10;
  double seconds_until(Blindness reason) {
    const double from = t;
    while (blindness() != reason && t - from < kNever) run(0.02);
    return std::min(t - from, kNever);
  }

  alert::Sight sight;
  recon::CameraModel camera = recon::make_camera_model(level_pixy2());
  bool camera_on = true;
  bool odometry_on = true;
  bool used = true;
  bool frozen = false;
  double aside_per_turn = 0;  ///< m a rad: a turn moves boxes as a step aside does; 0: turns do not show
  double image_every = 0;     ///< s; in between the last one is repeated
  std::vector<FlatFront> world = std::vector<FlatFront>(1, FlatFront{0.9, -0.2, 0.2, 1});
  double speed = 0.3;
  double turn = 0;
  double t = 0;
  double x = 0;
  double heading = 0;

 private:
  [[nodiscard]] sensor::OdometrySample sample() const {
    return {now(), base::Metres::nearest(x), {}, base::Radians::nearest(heading)};
  }
  recon::WaitingFrame view() {
    const bool repeats = t - last_image_ < image_every - 1e-6;
    if (!frozen && !repeats) {
      seen_ = flat_view(world, x, aside_per_turn * heading, t, 1);
      last_image_ = t;
    }
    seen_.t = now();
    return recon::make_waiting(seen_, 0);
  }

  double rate_;
  double last_frame_ = -1;
  double last_image_ = -1;
  sensor::BlobFrame seen_;
};

TEST(Sight, IsFineWhileBothSensorsAreHeard) {
  for (const double rate : {4.0, 10.0, 12.5, 50.0}) {
    Inputs inputs(rate);
    for (int i = 0; i < 100; ++i) {
      inputs.run(0.02);
      ASSERT_EQ(inputs.blindness(), Blindness::kNone) << rate << " frames/s at " << inputs.t << " s";
    }
    EXPECT_EQ(inputs.camera_state(), LinkState::kOk);
    EXPECT_EQ(inputs.odometry_state(), LinkState::kOk);
  }
}

TEST(Sight, ASilentCameraIsSaidInTime) {
  for (const double rate : {10.0, 12.5, 50.0}) {
    Inputs inputs(rate);
    inputs.run(1.5);
    inputs.camera_on = false;
    EXPECT_LE(inputs.seconds_until(Blindness::kCameraLate), 0.3) << rate;
    EXPECT_EQ(inputs.camera_state(), LinkState::kSilent);
    inputs.camera_on = true;
    inputs.run(1 / rate);
    EXPECT_EQ(inputs.blindness(), Blindness::kNone) << "it is back";
  }
}

// Two and a half of its intervals, smoothed over eight of them, within 0.27 and 1.5 s; of a robot that stands within 1
// s.
TEST(Rhythm, AnInputIsOverdueAfterItsUsualIntervals) {
  struct Row {
    std::vector<int> intervals;
    bool standing;
    int due;  // ms
  };
  for (const Row& row :
       {Row{{20, 20}, false, 270}, Row{{108}, false, 270}, Row{{120, 120}, false, 300}, Row{{400, 400}, false, 1'000},
        Row{{700}, false, 1'500}, Row{{9'000, 100}, false, 1'500}, Row{{100, 200}, false, 280},
        Row{{200, 120}, false, 475}, Row{{100}, true, 1'000}, Row{{440, 440}, true, 1'100}, Row{{700}, true, 1'500}}) {
    alert::Rhythm rhythm;
    base::Time t{10'000};
    EXPECT_FALSE(rhythm.overdue(t, row.standing)) << "before the first";
    rhythm.beat(t);
    for (const int interval : row.intervals) rhythm.beat(t = t + base::milliseconds(interval));
    EXPECT_FALSE(rhythm.overdue(t + base::milliseconds(row.due), row.standing)) << row.due;
    EXPECT_TRUE(rhythm.overdue(t + base::milliseconds(row.due) + base::Duration{1}, row.standing)) << row.due;
  }
}

TEST(Sight, SilentOdometryIsSaidInTime) {
  Inputs inputs;
  inputs.run(1);
  inputs.odometry_on = false;
  EXPECT_LE(inputs.seconds_until(Blindness::kOdometryLate), 0.3);
  EXPECT_EQ(inputs.odometry_state(), LinkState::kSilent);
}

TEST(Sight, ASensorThatNeverSpokeIsMissed) {
  Inputs camera;
  camera.camera_on = false;
  EXPECT_EQ(camera.camera_state(), LinkState::kAbsent);
  EXPECT_TRUE(camera.sight.nothing_seen());
  EXPECT_LE(camera.seconds_until(Blindness::kNoCamera), 0.3);
  Inputs odometry;
  odometry.odometry_on = false;
  odometry.used = false;
  EXPECT_EQ(odometry.odometry_state(), LinkState::kAbsent);
  EXPECT_LE(odometry.seconds_until(Blindness::kNoOdometry), 0.3);
}

TEST(Sight, FramesThatAreRefusedAreNoSight) {
  Inputs inputs;
  inputs.run(1);
  inputs.used = false;
  EXPECT_LE(inputs.seconds_until(Blindness::kFramesUnused), 0.3);
  EXPECT_EQ(inputs.camera_state(), LinkState::kUnready);
}

TEST(Sight, AFrozenCameraIsFoundByTheMotionThatItDoesNotShow) {
  Inputs straight;
  straight.run(1);
  straight.frozen = true;
  EXPECT_LE(straight.seconds_until(Blindness::kFrozen), 0.5);
  EXPECT_EQ(straight.camera_state(), LinkState::kUnready);
  straight.frozen = false;
  straight.run(0.2);
  EXPECT_EQ(straight.blindness(), Blindness::kNone);
  Inputs turning;
  turning.speed = 0;
  turning.turn = 0.5;
  turning.run(0.2);
  turning.frozen = true;
  EXPECT_LE(turning.seconds_until(Blindness::kFrozen), 0.3);
}

/// A camera that is asked 50 times a second and sees every so often; the motion moves boxes by far more than it takes.
Inputs repeating(double image_every) {
  Inputs inputs(50);
  inputs.speed = 0;
  inputs.turn = 0.1;
  inputs.world = {{2.5, -0.2, 0.2, 1}};
  inputs.aside_per_turn = 2.5;
  inputs.image_every = image_every;
  return inputs;
}

/// How long it was called frozen.
double frozen_within(Inputs& inputs, double seconds) {
  double frozen = 0;
  for (const double end = inputs.t + seconds - 1e-9; inputs.t < end;) {
    inputs.run(0.02);
    frozen += inputs.blindness() == Blindness::kFrozen ? 0.02 : 0;
  }
  return frozen;
}

TEST(Sight, ACameraThatIsAskedMoreOftenThanItSeesIsNotFrozen) {
  for (const double every : {0.1, 0.18, 0.22, 0.26}) {
    Inputs inputs = repeating(every);
    EXPECT_LE(frozen_within(inputs, 0.7), 0.1) << every << " s: it is found out by the first image that is late";
    EXPECT_EQ(frozen_within(inputs, 3), 0) << every;
    inputs.frozen = true;
    EXPECT_LE(inputs.seconds_until(Blindness::kFrozen), 0.38) << every;
  }
}

// Found by a storm: a right edge 31 columns further and a top one row higher were the same image to it.
TEST(Sight, EdgesThatMoveAgainstEachOtherAreAnotherImage) {
  alert::Sight sight;
  sight.start(base::Time::nearest(0));
  const recon::CameraModel camera = recon::make_camera_model(level_pixy2());
  for (int i = 0; i < 40; ++i) {
    const base::Time t = base::Time::nearest(0.05 * i);
    const sensor::OdometrySample sample{t, {}, {}, base::Radians::nearest(0.05 * i)};
    sensor::BlobFrame frame{t, static_cast<std::uint32_t>(i), {}};
    const bool further = i / 3 % 2 == 1;
    sensor::Blob blob;
    blob.signature = 2;
    blob.x1 = 20;
    blob.x2 = further ? 231 : 200;
    blob.y1 = further ? 120 : 121;
    blob.y2 = 180;
    ASSERT_TRUE(frame.blobs.push_back(blob));
    sight.odometry_came(sample);
    sight.frame_came(t);
    sight.frame_used(recon::make_waiting(frame, 0), camera, recon::to_map_pose(sample));
    EXPECT_EQ(sight.blindness(t, false), Blindness::kNone) << i;
  }
}

TEST(Sight, AQuickCameraThatWasLateOnceIsHeldToTheShortTime) {
  Inputs inputs = repeating(0.25);
  inputs.run(2);
  inputs.image_every = 0;
  inputs.run(0.1);
  inputs.frozen = true;
  EXPECT_LE(inputs.seconds_until(Blindness::kFrozen), 0.24);
  Inputs steady = repeating(0.18);
  steady.run(2);
  steady.frozen = true;
  EXPECT_LE(steady.seconds_until(Blindness::kFrozen), 0.22) << "it was never late";
}

TEST(Sight, ImagesThatAreSlowerThanOneMayDriveByAreSaidEachTime) {
  Inputs inputs = repeating(0.4);
  inputs.run(1);
  EXPECT_GT(frozen_within(inputs, 4), 1.5);
}

// A thing that stays as it is before a stationary robot shows nothing about the camera.
TEST(Sight, AStandstillMakesNoCameraSlow) {
  Inputs inputs = repeating(0);
  inputs.turn = 0;
  for (int i = 0; i < 5; ++i) {
    inputs.run(0.26);
    inputs.heading += 0.01;  // noise of pixels
  }
  inputs.run(0.02);
  inputs.turn = 0.1;
  inputs.frozen = true;
  EXPECT_LE(inputs.seconds_until(Blindness::kFrozen), 0.24);
}

TEST(Sight, WhatCannotChangeIsNotFrozen) {
  Inputs standing;
  standing.speed = 0;
  EXPECT_EQ(standing.seconds_until(Blindness::kFrozen), Inputs::kNever) << "nothing moves";
  Inputs wavering;  // where headings wrap
  wavering.speed = 0;
  wavering.heading = 3.14155;
  wavering.run(1);
  wavering.heading = -3.14155;
  EXPECT_EQ(wavering.seconds_until(Blindness::kFrozen), Inputs::kNever) << "nor there";
  Inputs no_floor;  // no row says how far a foot is
  no_floor.camera.height = 0;
  no_floor.frozen = true;
  EXPECT_EQ(no_floor.seconds_until(Blindness::kFrozen), Inputs::kNever) << "a way straight on does not show";
  Inputs empty;
  empty.world.clear();
  EXPECT_EQ(empty.seconds_until(Blindness::kFrozen), Inputs::kNever) << "nothing is there";
  EXPECT_EQ(empty.camera_state(), LinkState::kEmpty);
  Inputs before_a_wall;
  before_a_wall.world = {{0.12, -5, 5, 1}};
  before_a_wall.speed = 0;
  before_a_wall.turn = 0.05;
  before_a_wall.run(0.5);
  before_a_wall.frozen = true;
  EXPECT_EQ(before_a_wall.seconds_until(Blindness::kFrozen), Inputs::kNever) << "it fills the image";
}

// 0.1 m and 5 m/s; 0.6667 rad and 33.33 rad/s. For half a second.
TEST(Sight, OdometryThatJumpsIsNotBelieved) {
  struct Row {
    int ms, x, y, heading;  // mm, mrad
    bool jumps;
  };
  for (const Row& row : {Row{20, 199, 0, 0, false}, Row{20, 201, 0, 0, true}, Row{20, 0, -199, 0, false},
                         Row{20, 0, -201, 0, true}, Row{100, 0, 599, 0, false}, Row{100, -601, 0, 0, true},
                         Row{100, 450, 450, 0, true}, Row{20, 0, 0, 1'333, false}, Row{20, 0, 0, 1'334, true},
                         Row{20, 0, 0, -1'334, true}, Row{20, 0, 0, -6'283, false}}) {
    alert::Sight sight;
    const base::Time t = base::Time{10'000} + base::milliseconds(row.ms);
    const base::Radians from{5'000};
    sight.start({});
    sight.odometry_came({{10'000}, {20'000}, {-30'000}, from});
    sight.odometry_came({t, {20'000 + 10 * row.x}, {-30'000 + 10 * row.y}, {from.raw + 10 * row.heading}});
    sight.frame_came(t);
    const auto where = testing::Message() << row.ms << " " << row.x << " " << row.y << " " << row.heading;
    EXPECT_EQ(sight.odometry_state(t, true), row.jumps ? LinkState::kUnready : LinkState::kOk) << where;
    EXPECT_EQ(sight.blindness(t, true) == Blindness::kJump, row.jumps) << where;
    const base::Time last = t + base::milliseconds(500);
    EXPECT_EQ(sight.odometry_state(last, true), LinkState::kOk) << where;
    EXPECT_EQ(sight.odometry_state(last - base::Duration{1}, true) == LinkState::kUnready, row.jumps) << where;
  }
}

}  // namespace
}  // namespace fencepost::test
