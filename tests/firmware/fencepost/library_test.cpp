#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "host/replay/replay.hpp"
#include "tests/firmware/fencepost/played_log.hpp"

namespace fencepost::test {
namespace {

template <class Size>
class LibraryOfSize : public testing::Test {
 protected:
  std::unique_ptr<Core<Size>> core_ = std::make_unique<Core<Size>>();
};
using Sizes = testing::Types<Micro, Small, Full>;
TYPED_TEST_SUITE(LibraryOfSize, Sizes);

template <class Size>
constexpr const char* kName = "full";
template <>
constexpr const char* kName<Small> = "small";
template <>
constexpr const char* kName<Micro> = "micro";

host::ReplayOutcome at_the_desk(const std::string& bytes, const std::string& profile, bool check = false) {
  host::ReplayOptions options;
  options.profile = profile;
  options.check = check;
  return host::replay(bytes, "test", options);
}

TYPED_TEST(LibraryOfSize, GivesTheBitsOfTheDesk) {
  for (const char* name : {"noisy_arc.log", "corridor.log", "stop_pixy2.log"}) {
    this->core_->restart();
    const std::string bytes = bundled(name);
    const auto played = play(*this->core_, bytes);
    EXPECT_GT(played.inputs, 300);
    EXPECT_EQ(played.refused, 0) << name;
    EXPECT_EQ(this->core_->digest(), at_the_desk(bytes, kName<TypeParam>).result.digest) << name;
  }
}

TYPED_TEST(LibraryOfSize, ItsLogIsPlayedAgainAtTheDesk) {
  std::string log;
  this->core_->on_log(
      [](void* context, const char* text, std::size_t size) { static_cast<std::string*>(context)->append(text, size); },
      &log);
  const auto played = play(*this->core_, bundled("corridor.log"));
  this->core_->step(played.last + 5'000'000);  // time passes without inputs, too
  EXPECT_EQ(played.refused, 0);
  const host::ReplayOutcome again = at_the_desk(log, "", true);
  ASSERT_FALSE(again.unreadable) << again.unreadable->message;
  EXPECT_EQ(again.result.digest, this->core_->digest());
  EXPECT_GT(again.check.compared, 100U);
  EXPECT_EQ(again.check.differing, 0U) << again.check.mismatches.front();
  // With and without a log the same.
  auto silent = std::make_unique<Core<TypeParam>>();
  play(*silent, bundled("corridor.log"));
  EXPECT_EQ(silent->digest(), this->core_->digest());
}

struct Heard {
  std::vector<Level> levels;
  std::vector<std::string> sentences;
  Alert last;
};
void hear(void* context, const Alert& alert) {
  auto& heard = *static_cast<Heard*>(context);
  heard.levels.push_back(alert.level);
  heard.sentences.emplace_back(alert.sentence);
  heard.last = alert;
}

TYPED_TEST(LibraryOfSize, TellsOfTheBoxAheadAndStops) {
  Heard heard;
  this->core_->on_alert(hear, &heard);
  const auto played = play(*this->core_, bundled("stop_pixy2.log"));
  for (const Level level : {Level::kNotice, Level::kWarn, Level::kStop}) {
    EXPECT_NE(std::find(heard.levels.begin(), heard.levels.end(), level), heard.levels.end());
  }
  EXPECT_EQ(heard.last.level, Level::kStop);
  EXPECT_EQ(heard.sentences.back().substr(0, 8), "STOP    ");
  EXPECT_NE(heard.sentences.back().find("red  0."), std::string::npos) << heard.sentences.back();
  EXPECT_LT(heard.last.distance, 0.35F);
  EXPECT_GT(heard.last.contact, 0);
  EXPECT_LE(heard.last.time, played.last);
  EXPECT_EQ(this->core_->level(), Level::kStop);
  EXPECT_FALSE(this->core_->may_drive(played.last));

  // The robot's origin is at x = 1.6 m then, the box's middle at (1.86, 0): tests/README.md.
  Object object;
  ASSERT_EQ(this->core_->objects(&object, 1), 1U);
  EXPECT_TRUE(object.confirmed);
  EXPECT_NEAR(object.x, 1.86, 0.05);
  EXPECT_NEAR(object.y, -0.01, 0.03);
  EXPECT_NEAR(object.radius, 0.06, 0.03);
  Pose pose{};
  ASSERT_TRUE(this->core_->pose(pose));
  EXPECT_NEAR(object.distance, std::hypot(object.x - pose.x, object.y - pose.y) - object.radius, 0.03);
  std::array<Point, kMostCorners> corners{};
  const std::size_t count = this->core_->outline(object.id, corners.data(), corners.size());
  ASSERT_GE(count, 3U);
  float twice = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Point &a = corners[i], &b = corners[(i + 1) % count];
    EXPECT_LT(std::hypot(a.x - object.x, a.y - object.y), 0.2F);
    twice += (a.x - object.x) * (b.y - object.y) - (a.y - object.y) * (b.x - object.x);
  }
  EXPECT_GT(twice, 0);  // counter-clockwise
  EXPECT_EQ(this->core_->outline(object.id + 1, corners.data(), corners.size()), 0U);
}

TYPED_TEST(LibraryOfSize, ASilentCameraIsNoticedAndMotorsMayNotRun) {
  Heard heard;
  this->core_->on_alert(hear, &heard);
  EXPECT_EQ(this->core_->level(), Level::kBlind);
  EXPECT_FALSE(this->core_->may_drive(0));
  Camera camera = delivered_camera("pixy2");
  camera.z = 0.12F;
  ASSERT_EQ(this->core_->set_camera(camera), Answer::kTaken);
  std::int64_t now = 1'000'000;
  const auto drive = [&](int turns, bool sees) {
    for (int i = 0; i < turns; ++i, now += 50'000) {
      ASSERT_EQ(this->core_->odometry(now, {static_cast<float>(now) * 1e-7F, 0, 0}), Answer::kTaken);
      const Box far{1, static_cast<std::int16_t>(140 + i % 2), 100, 150, 110};
      if (sees) {
        ASSERT_EQ(this->core_->boxes(now, &far, 1), Answer::kTaken);
      }
      this->core_->step(now);
    }
  };
  drive(40, true);
  EXPECT_LT(this->core_->level(), Level::kStop);
  EXPECT_TRUE(this->core_->may_drive(now));
  EXPECT_FALSE(this->core_->may_drive(now + 400'000)) << "step() was not called";
  drive(40, false);
  EXPECT_EQ(this->core_->level(), Level::kBlind);
  EXPECT_FALSE(this->core_->may_drive(now));
  EXPECT_EQ(heard.sentences.back(), "BLIND   no frame comes from the camera");
}

TEST(Library, SaysWhatItDidNotTake) {
  auto core = std::make_unique<SmallCore>();
  const Box box{1, 10, 10, 20, 20};
  EXPECT_EQ(core->boxes(0, &box, 1), Answer::kNoCamera);
  EXPECT_EQ(core->set_camera({}), Answer::kRange);
  Camera camera = delivered_camera("pixy2");
  EXPECT_EQ(camera.width, 316);
  EXPECT_EQ(delivered_camera("no such camera").width, 0);
  camera.pitch = NAN;
  EXPECT_EQ(core->set_camera(camera), Answer::kRange);
  camera.pitch = 0;
  EXPECT_EQ(core->set_camera(camera), Answer::kTaken);
  EXPECT_EQ(core->set("robot.width", "0.18"), Answer::kTaken);
  EXPECT_EQ(core->set("robot.width", "wide"), Answer::kRange);
  EXPECT_EQ(core->set("robot.widht", "0.18"), Answer::kUnknown);
  for (std::uint8_t i = 1; i <= Small::kObjects; ++i) EXPECT_EQ(core->set_name(i, "red"), Answer::kTaken);
  EXPECT_EQ(core->set_name(9, "blue"), Answer::kFull);
  EXPECT_EQ(core->odometry(-1, {0, 0, 0}), Answer::kRange);
  EXPECT_EQ(core->odometry(100, {1000.1F, 0, 0}), Answer::kRange);
  EXPECT_EQ(core->odometry(100, {INFINITY, 0, 0}), Answer::kRange);
  EXPECT_EQ(core->odometry(100, {0, 0, 0}), Answer::kTaken);
  EXPECT_EQ(core->odometry(199, {0, 0, 0}), Answer::kTime);
  const Box outside{1, 10, 10, 316, 20};
  EXPECT_EQ(core->boxes(100, &outside, 1), Answer::kRange);
  EXPECT_EQ(core->boxes(100, &box, 1), Answer::kTaken);
  EXPECT_EQ(core->boxes(100, nullptr, 0), Answer::kTime);
  EXPECT_EQ(core->boxes(300, nullptr, 0), Answer::kTaken);
}

// Twenty boxes, the sixteen largest in any order: the same map.
TEST(Library, UsesTheLargestBoxes) {
  const auto digest = [](bool backwards, std::int16_t count) {
    auto core = std::make_unique<FullCore>();
    core->set_camera(delivered_camera("pixy2"));
    std::array<Box, 20> boxes{};
    for (std::int16_t i = 0; i < count; ++i) {
      const auto x = static_cast<std::int16_t>(15 * i);
      boxes[static_cast<std::size_t>(i)] = {1, x, 100, static_cast<std::int16_t>(x + 3),
                                            static_cast<std::int16_t>(130 - i)};
    }
    const auto end = boxes.begin() + count;
    if (backwards) std::reverse(boxes.begin(), end);
    core->odometry(0, {0, 0, 0});
    core->odometry(100'000, {0, 0, 0});
    core->boxes(100'000, boxes.data(), static_cast<std::size_t>(count));
    return core->digest();
  };
  EXPECT_EQ(digest(false, 20), digest(true, 20));
  EXPECT_EQ(digest(false, 20), digest(false, 16));
  EXPECT_NE(digest(false, 20), digest(false, 15));
}

TEST(Library, IsOfTheProjectsVersion) { EXPECT_STREQ(kVersion, FENCEPOST_VERSION); }

TEST(WideClock, GoesOnWhereTheNarrowOneWraps) {
  WideClock clock;
  EXPECT_EQ(clock.at(0xFFFFFF00U), 0xFFFFFF00LL);
  EXPECT_EQ(clock.at(0x00000100U), 0x100000100LL);
  EXPECT_EQ(clock.at(0x00000100U), 0x100000100LL);
}

}  // namespace
}  // namespace fencepost::test
