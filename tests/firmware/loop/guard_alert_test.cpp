// The guard's alert in a whole run: object id 0, said where no object says as much, and always taken back.
#include <gtest/gtest.h>

#include <array>
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "firmware/loop/pipeline.hpp"
#include "firmware/record/stream_reader.hpp"
#include "tests/firmware/level_pixy2.hpp"
#include "tests/firmware/recon/guard/flat_world.hpp"

namespace fencepost::test {
namespace {

using record::AlertLevel;

struct Alerts {
  std::vector<record::AlertReport> all;
  void accept(const record::AlertReport& report) { all.push_back(report); }
  template <class Record>
  void accept(const Record& /*not asked for*/) {}
};

/// A robot in a flat world. Odometry at 100 samples a second, frames at `rate`.
template <class Base = config::Small>
class Drive {
 public:
  using Profile = loop::Journaled<Base, 64 * 1024>;

  explicit Drive(double rate = 10) : rate_(rate) {
    memory->journal.start();
    pipeline.start_run(header_);
    pipeline.set_camera(level_pixy2());
  }

  /// For `seconds` at `speed` m/s along x, turning at `turn` rad/s.
  void go(double seconds, double speed, const std::vector<FlatFront>& world, double turn = 0) {
    const auto steps = static_cast<int>(std::lround(seconds * 100));
    for (int i = 0; i < steps; ++i) {
      t += 0.01;
      heading += 0.01 * turn;
      x += 0.01 * speed * std::cos(heading);
      pipeline.accept(sensor::OdometrySample{
          base::Time::nearest(t), base::Metres::nearest(x), {}, base::Radians::nearest(heading)});
      if (t - last_frame_ > 1 / rate_ - 1e-6) {
        last_frame_ = t;
        on_their_way_.push_back(flat_view(world, x, 0, t + 0.05, number_++));
      }
      while (!on_their_way_.empty() && on_their_way_.front().t.to_double() < t + 0.005) {
        pipeline.accept(on_their_way_.front());
        on_their_way_.pop_front();
      }
      while (pipeline.place_next_frame()) {
      }
      pipeline.watch_without_frames();
      const std::span<const char> lines = memory->journal.waiting();
      reader_.push({lines.data(), lines.size()}, alerts);
      memory->journal.taken(lines.size());
    }
  }

  /// The last word about each id; clear for those that were never named.
  [[nodiscard]] AlertLevel level_of(std::uint32_t id) const {
    AlertLevel level = AlertLevel::kClear;
    for (const record::AlertReport& alert : alerts.all) {
      if (alert.id == id) level = alert.level;
    }
    return level;
  }
  [[nodiscard]] AlertLevel highest() const {
    std::map<std::uint32_t, AlertLevel> last;
    for (const record::AlertReport& alert : alerts.all) last[alert.id] = alert.level;
    AlertLevel level = AlertLevel::kClear;
    for (const auto& [id, said] : last) level = std::max(level, said);
    return level;
  }

  std::unique_ptr<loop::Memory<Profile>> memory = std::make_unique<loop::Memory<Profile>>();
  loop::Pipeline<Profile> pipeline{*memory, console::Mode::kQuiet};
  Alerts alerts;
  double t = 0;
  double x = 0;
  double heading = 0;

 private:
  double rate_;
  double last_frame_ = 0;
  std::deque<sensor::BlobFrame> on_their_way_;
  std::uint32_t number_ = 0;
  record::Header header_{1, "fencepost", "0.0.0", "test", Base::kName};
  std::array<char, record::StreamReader::kBuffer> buffer_{};
  record::StreamReader reader_{buffer_};
};

const FlatFront kWall{1.0, -3, 3};  // wider than the view, so no object ever begins

TEST(GuardAlert, AWallWiderThanTheViewStopsTheRobotInTime) {
  for (const double rate : {10.0, 50.0}) {
    for (const double speed : {0.05, 0.1, 0.2}) {
      Drive robot(rate);
      robot.go(0.65 / speed, speed, {kWall});
      EXPECT_NE(robot.highest(), AlertLevel::kStop) << "0.35 m is not near, at " << speed << " m/s, rate " << rate;
      EXPECT_EQ(robot.level_of(record::kNoObject), AlertLevel::kWarn);
      robot.go(0.1 / speed, speed, {kWall});
      ASSERT_EQ(robot.level_of(record::kNoObject), AlertLevel::kStop) << speed << " m/s, rate " << rate;
      const record::AlertReport& last = robot.alerts.all.back();
      EXPECT_EQ(last.id, record::kNoObject);
      EXPECT_EQ(last.signature, 1);
      EXPECT_NEAR(last.distance.to_double(), 1.0 - robot.x, 0.03);
      EXPECT_NEAR(last.bearing.to_double(), 0, 0.4);
      EXPECT_TRUE(last.ttc.has_value());
      EXPECT_EQ(last.confidence.raw, 100);
    }
  }
}

// robot.width says nothing of a nose of 0.4 m: without robot.front it stops at 0.25 m from the origin, in the wall.
TEST(GuardAlert, StopsBeforeTheNoseTouches) {
  for (const double speed : {0.05, 0.2}) {
    Drive robot;
    ASSERT_FALSE(robot.pipeline.set("robot.front", "0.4"));
    robot.go(0.40 / speed, speed, {kWall});
    EXPECT_EQ(robot.highest(), AlertLevel::kWarn) << speed;
    robot.go(0.06 / speed, speed, {kWall});
    ASSERT_EQ(robot.highest(), AlertLevel::kStop) << "0.54 m from the origin, 0.14 m from the nose, at " << speed;
    const record::AlertReport& last = robot.alerts.all.back();
    EXPECT_NEAR(last.distance.to_double(), 1.0 - robot.x, 0.06);
    EXPECT_NEAR(last.ttc->to_double(), (1.0 - robot.x - 0.4) / speed, 0.05 / speed);
  }
}

// Turned round before the wall, it backs towards what it does not see any more.
TEST(GuardAlert, StopsWhenTheRearReachesTheWallBehind) {
  for (const bool told : {true, false}) {
    Drive robot;
    if (told) {
      ASSERT_FALSE(robot.pipeline.set("robot.rear", "0.3"));
    }
    robot.go(2, 0.2, {kWall});  // 0.6 m before it
    robot.go(3.14159 / 1.5, 0, {}, 1.5);
    robot.go(0.7, 0, {});
    ASSERT_EQ(robot.highest(), AlertLevel::kClear);
    robot.go(0.5, -0.2, {});
    EXPECT_NE(robot.highest(), AlertLevel::kStop) << "0.5 m";
    robot.go(0.35, -0.2, {});  // 0.43 m from the origin, 0.13 m from the rear
    EXPECT_EQ(robot.highest() == AlertLevel::kStop, told);
    robot.go(5, 0, {});
    EXPECT_EQ(robot.highest() == AlertLevel::kStop, told) << "it obeyed";
    if (told) {
      EXPECT_NEAR(std::fabs(robot.alerts.all.back().bearing.to_double()), 3.14, 0.5);
    }
  }
}

// Below the lens nothing is seen any more. The robot obeys, stands for ten minutes, and is still told to stop.
TEST(GuardAlert, LastsWhileTheObstacleIsBelowTheImage) {
  Drive robot;
  robot.go(3.25, 0.2, {kWall});
  robot.go(0.45, 0.2, {});  // it is lower than the lens
  ASSERT_EQ(robot.level_of(record::kNoObject), AlertLevel::kStop);
  robot.go(600, 0, {});
  EXPECT_EQ(robot.level_of(record::kNoObject), AlertLevel::kStop);
  robot.go(1, -0.2, {});  // what is ahead is not on its way now
  EXPECT_EQ(robot.level_of(record::kNoObject), AlertLevel::kClear);
  robot.go(1, 0.1, {});  // and 0.45 m away it saw that nothing is there
  EXPECT_EQ(robot.level_of(record::kNoObject), AlertLevel::kClear);
}

// Taken away before its eyes: clear within a second, whatever is behind it and at any rate.
TEST(GuardAlert, EndsWithinASecondWhenTheObstacleIsTakenAway) {
  for (const double rate : {10.0, 12.5, 50.0}) {
    for (const bool wall_behind : {false, true}) {
      Drive robot(rate);
      robot.go(3, 0.2, {kWall});  // 0.4 m
      ASSERT_EQ(robot.level_of(record::kNoObject), AlertLevel::kWarn);
      std::vector<FlatFront> background;
      if (wall_behind) background.push_back({1.5, -3, 3, 2});
      robot.go(1, 0, background);
      EXPECT_EQ(robot.level_of(record::kNoObject), AlertLevel::kClear) << rate << " wall " << wall_behind;
    }
  }
}

// An alert that eases is in force for a while yet: until then nobody is told that it is over.
TEST(GuardAlert, IsNotTakenBackWhileItIsInForce) {
  Drive robot(50);
  robot.go(3, 0.2, {kWall});
  std::size_t told = robot.alerts.all.size();
  unsigned clears = 0;
  for (int i = 0; i < 150; ++i) {
    robot.go(0.01, 0, {});
    for (; told < robot.alerts.all.size(); ++told) {
      const record::AlertReport& alert = robot.alerts.all[told];
      if (alert.id != record::kNoObject || alert.level != AlertLevel::kClear) continue;
      ++clears;
      EXPECT_EQ(robot.pipeline.in_force().level, AlertLevel::kClear) << alert.t.raw;
    }
  }
  EXPECT_EQ(clears, 1U);
}

// A post is an object's to tell: the guard has nothing to add.
TEST(GuardAlert, DoesNotRepeatWhatAnObjectSays) {
  Drive robot;
  const FlatFront post{1.0, -0.05, 0.05};
  robot.go(3.6, 0.2, {post});
  EXPECT_EQ(robot.highest(), AlertLevel::kStop);
  for (const record::AlertReport& alert : robot.alerts.all) {
    if (alert.id != record::kNoObject) continue;
    // Only while it is the first to know: for some frames, before the object says as much.
    AlertLevel others = AlertLevel::kClear;
    for (const record::AlertReport& other : robot.alerts.all) {
      if (other.id != record::kNoObject && other.t <= alert.t) others = other.level;
    }
    EXPECT_TRUE(alert.level == AlertLevel::kClear || alert.level >= others);
  }
}

// The map loses what it knew: the table gives its slot to others, the object is two, a restart of its models. What
// stands there is still told of.
TEST(GuardAlert, CoversWhatTheMapLoses) {
  Drive<config::Micro> robot;
  const FlatFront post{0.8, -0.06, 0.06};
  robot.go(2, 0.2, {post});
  ASSERT_GE(robot.highest(), AlertLevel::kWarn);
  // In two pieces with a gap: the object divides.
  const std::vector<FlatFront> halves = {{0.8, -0.06, -0.015}, {0.8, 0.015, 0.06}};
  for (int i = 0; i < 20; ++i) {
    robot.go(0.1, 0.02, halves);
    EXPECT_GE(robot.highest(), AlertLevel::kWarn) << i;
  }
}

TEST(GuardAlert, ANewRunAndANewCalibrationForget) {
  Drive robot;
  robot.go(3.7, 0.2, {kWall});
  ASSERT_FALSE(robot.memory->map.guard().fronts().empty());
  robot.pipeline.set_camera(level_pixy2());  // the same again
  EXPECT_FALSE(robot.memory->map.guard().fronts().empty());
  sensor::CameraIntrinsics other = level_pixy2();
  other.mount.z = base::Metres::nearest(0.13);
  robot.pipeline.set_camera(other);
  EXPECT_TRUE(robot.memory->map.guard().fronts().empty());
  robot.go(1, 0, {});
  EXPECT_EQ(robot.level_of(record::kNoObject), AlertLevel::kClear) << "and clear was said";
  robot.go(2, -0.2, {kWall});
  ASSERT_FALSE(robot.memory->map.guard().fronts().empty());
  robot.pipeline.restart();
  EXPECT_TRUE(robot.memory->map.guard().fronts().empty());
}

// Two runs that differ in what the guard knows alone.
TEST(GuardAlert, IsPartOfTheDigest) {
  const auto digest = [](bool other) {
    Drive robot;
    robot.go(1, 0.1, {kWall});
    if (other) robot.memory->map.recalibrated();
    robot.go(1, 0.1, {});
    return robot.memory->map.digest();
  };
  EXPECT_EQ(digest(false), digest(false));
  EXPECT_NE(digest(false), digest(true));
}

}  // namespace
}  // namespace fencepost::test
