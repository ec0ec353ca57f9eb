#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <type_traits>

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

template <class Size>
const fencepost_capacity* kCapacity = fencepost_full();
template <>
const fencepost_capacity* kCapacity<Small> = fencepost_small();
template <>
const fencepost_capacity* kCapacity<Micro> = fencepost_micro();

// The C interface in the place of a Core.
struct ByHandle {
  fencepost_core* core;

  Answer set_camera(const Camera& camera) { return Answer(fencepost_set_camera(core, &camera)); }
  Answer set(const char* key, const char* value) { return Answer(fencepost_set(core, key, value)); }
  Answer set_colour(const Colour& colour) { return Answer(fencepost_set_colour(core, &colour)); }
  Answer odometry(std::int64_t time, const Pose& pose) { return Answer(fencepost_odometry(core, time, pose)); }
  Answer boxes(std::int64_t time, const Box* first, std::size_t count) {
    return Answer(fencepost_boxes(core, time, first, count));
  }
};

TYPED_TEST(LibraryOfSize, DoesTheSameByItsCInterface) {
  std::vector<std::uint64_t> memory(fencepost_bytes(kCapacity<TypeParam>) / sizeof(std::uint64_t));
  ByHandle handle{fencepost_init(memory.data(), memory.size() * sizeof(std::uint64_t), kCapacity<TypeParam>)};
  ASSERT_NE(handle.core, nullptr);
  const std::string bytes = bundled("corridor.log");
  const auto mine = play(*this->core_, bytes);
  const auto theirs = play(handle, bytes);
  EXPECT_EQ(theirs.inputs, mine.inputs);
  EXPECT_EQ(theirs.refused, 0);
  EXPECT_EQ(fencepost_digest(handle.core), this->core_->digest());
  std::vector<Object> objects(TypeParam::kObjects);
  EXPECT_EQ(fencepost_objects(handle.core, objects.data(), objects.size()),
            this->core_->objects(objects.data(), objects.size()));
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

  // The robot's origin is at x = 1.6 m then, the box's middle at (1.86, 0): host/share/recordings/stop_pixy2.json.
  Object object;
  ASSERT_EQ(this->core_->objects(&object, 1), 1U);
  EXPECT_TRUE(object.confirmed);
  EXPECT_NEAR(object.x, 1.86, 0.05);
  EXPECT_NEAR(object.y, -0.01, 0.03);
  EXPECT_NEAR(object.radius, 0.06, 0.03);
  Pose pose{};
  ASSERT_TRUE(this->core_->pose(pose));
  EXPECT_NEAR(object.distance, std::hypot(object.x - pose.x, object.y - pose.y) - object.radius, 0.03);
  std::array<Point, kMaxCorners> corners{};
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

TYPED_TEST(LibraryOfSize, ItsColoursAreInTheLogAndANameLeavesTheRest) {
  std::string log;
  const auto keep = [](void* to, const char* text, std::size_t size) {
    static_cast<std::string*>(to)->append(text, size);
  };
  this->core_->on_log(keep, &log);
  Colour colour{};
  colour.signature = 3;
  colour.red = 0xD0;
  colour.green = 0x20;
  colour.blue = 0x21;
  colour.size = 0.05F;
  colour.pad = -4;
  colour.name = "ball";
  ASSERT_EQ(this->core_->set_colour(colour), Answer::kTaken);
  this->core_->step(0);
  EXPECT_NE(log.find("$FPSIG,3,d02021,ball,0.050,-4*"), std::string::npos) << log;
  ASSERT_EQ(this->core_->set_name(3, "cone"), Answer::kTaken);
  this->core_->step(100);
  EXPECT_NE(log.find("$FPSIG,3,d02021,cone,0.050,-4*"), std::string::npos) << log;
}

TYPED_TEST(LibraryOfSize, SaysWhichWaysAreFree) {
  std::array<Way, kWays> ways{};
  EXPECT_EQ(this->core_->ways(ways.data(), kWays), 0U) << "no odometry yet";
  play(*this->core_, bundled("stop_pixy2.log"));
  const std::size_t count = this->core_->ways(ways.data(), kWays);
  if (std::is_same_v<TypeParam, Micro>) {
    EXPECT_EQ(count, 0U);
    return;
  }
  ASSERT_EQ(count, kWays);
  EXPECT_EQ(ways[4].motion, FENCEPOST_FORWARD);
  EXPECT_EQ(ways[4].curvature, 0);
  EXPECT_EQ(ways[4].end, FENCEPOST_END_THING) << "the box before which it stands";
  EXPECT_LT(ways[4].free, 0.3F);
  EXPECT_EQ(ways[8].end, FENCEPOST_END_UNKNOWN) << "it never looked behind";
  EXPECT_EQ(this->core_->ways(ways.data(), 2), 2U);
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
  EXPECT_EQ(core->set_name(9, "blue"), Answer::kNoRoom);
  Colour colour{};
  for (const float size : {-0.05F, 0.0001F, 2.1F, NAN, INFINITY}) {
    colour.size = size;
    EXPECT_EQ(core->set_colour(colour), Answer::kRange) << size;
  }
  colour.size = 2;
  EXPECT_EQ(core->set_colour(colour), Answer::kNoRoom) << "a ninth";
  colour.signature = 1;
  colour.pad = 101;
  EXPECT_EQ(core->set_colour(colour), Answer::kRange);
  colour.pad = -100;
  EXPECT_EQ(core->set_colour(colour), Answer::kTaken);
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
    EXPECT_EQ(core->set_camera(delivered_camera("pixy2")), Answer::kTaken);
    std::array<Box, 20> boxes{};
    for (std::int16_t i = 0; i < count; ++i) {
      const auto x = static_cast<std::int16_t>(15 * i);
      boxes[static_cast<std::size_t>(i)] = {1, x, 100, static_cast<std::int16_t>(x + 3),
                                            static_cast<std::int16_t>(130 - i)};
    }
    const auto end = boxes.begin() + count;
    if (backwards) std::reverse(boxes.begin(), end);
    EXPECT_EQ(core->odometry(0, {0, 0, 0}), Answer::kTaken);
    EXPECT_EQ(core->odometry(100'000, {0, 0, 0}), Answer::kTaken);
    EXPECT_EQ(core->boxes(100'000, boxes.data(), static_cast<std::size_t>(count)), Answer::kTaken);
    return core->digest();
  };
  EXPECT_EQ(digest(false, 20), digest(true, 20));
  EXPECT_EQ(digest(false, 20), digest(false, 16));
  EXPECT_NE(digest(false, 20), digest(false, 15));
}

TEST(Library, TakesSettingsAsNumbers) {
  std::string log;
  auto core = std::make_unique<SmallCore>();
  core->on_log([](void* to, const char* text, std::size_t size) { static_cast<std::string*>(to)->append(text, size); },
               &log);
  EXPECT_EQ(core->set("robot.width", 0.184F), Answer::kTaken);
  EXPECT_EQ(core->set("confirm.n", 7), Answer::kTaken);
  EXPECT_EQ(core->set("alert.notice", 1.249F), Answer::kTaken);
  EXPECT_EQ(core->set("steer.offset", -1.25F), Answer::kTaken);
  EXPECT_EQ(core->set("steer.offset", -45.1F), Answer::kRange);
  EXPECT_EQ(core->set("robot.width", 5.1F), Answer::kRange);
  EXPECT_EQ(core->set("robot.width", NAN), Answer::kRange);
  EXPECT_EQ(core->set("robot.width", INFINITY), Answer::kRange);
  EXPECT_EQ(core->set("robot.widht", 0.2F), Answer::kUnknown);
  EXPECT_EQ(core->set("correct.pose", 1), Answer::kRange) << "its values are words";
  EXPECT_EQ(core->odometry(0, {0, 0, 0}), Answer::kTaken);
  core->step(1);
  for (const char* line : {"$FPCFG,robot.width,0.18*", "$FPCFG,confirm.n,7*", "$FPCFG,alert.notice,1.25*"}) {
    EXPECT_NE(log.find(line), std::string::npos) << line << " is not in\n" << log;
  }
}

// 640 columns at 62 degrees: 320 / tan(31 degrees) = 532.57 px.
TEST(Library, MakesAPinhole) {
  const Camera camera = Camera::pinhole(640, 480, 62);
  EXPECT_EQ(camera.width, 640);
  EXPECT_EQ(camera.height, 480);
  EXPECT_NEAR(camera.fx, 532.57, 0.02);
  EXPECT_EQ(camera.fy, camera.fx);
  EXPECT_EQ(camera.cx, 319.5F);
  EXPECT_EQ(camera.cy, 239.5F);
  EXPECT_FALSE(camera.pitch_unknown);
  auto core = std::make_unique<MicroCore>();
  EXPECT_EQ(core->set_camera(camera), Answer::kTaken);
  for (const float degrees : {0.0F, -62.0F, 171.0F, NAN}) EXPECT_EQ(Camera::pinhole(640, 480, degrees).width, 0);
}

TEST(Library, MakesABoxOfItsMiddleAndSize) {
  const auto corners = [](const Box& box) { return std::array{box.left, box.top, box.right, box.bottom}; };
  using Corners = std::array<std::int16_t, 4>;
  EXPECT_EQ(corners(Box::centred(3, 20, 30, 9, 1)), (Corners{16, 30, 24, 30}));
  EXPECT_EQ(corners(Box::centred(3, 19.5F, 30, 10, 0.2F)), (Corners{15, 30, 24, 30}));
  EXPECT_EQ(corners(Box::centred(3, 2, 2, 10, 10)), (Corners{-2, -2, 7, 7})) << "the core refuses it";
  EXPECT_EQ(Box::centred(3, 2, 2, 10, 10).signature, 3);
  auto core = std::make_unique<MicroCore>();
  ASSERT_EQ(core->set_camera(delivered_camera("pixy2")), Answer::kTaken);
  for (const float bad : {NAN, -1.0F, 1e30F}) {
    const Box box = Box::centred(1, 100, 100, bad, 10);
    EXPECT_LT(box.right, box.left);
    EXPECT_EQ(core->boxes(0, &box, 1), Answer::kRange);
  }
  const Box box = Box::centred(1, 100, 100, 10, 10);
  EXPECT_EQ(core->boxes(0, &box, 1), Answer::kTaken);
}

TYPED_TEST(LibraryOfSize, KnowsDistancesAllAround) {
  std::array<float, kSectors> sectors{};
  EXPECT_EQ(this->core_->sectors(sectors.data(), sectors.size()), 0U) << "no odometry yet";
  play(*this->core_, bundled("stop_pixy2.log"));
  const std::size_t count = this->core_->sectors(sectors.data(), sectors.size());
  if (TypeParam::kObjects > Micro::kObjects) {
    const auto desk = at_the_desk(bundled("stop_pixy2.log"), kName<TypeParam>).result.sectors;
    ASSERT_TRUE(desk);
    ASSERT_EQ(count, desk->sectors.size());
    for (std::size_t i = 0; i < count; ++i) {
      const auto& distance = desk->sectors[i].distance;
      EXPECT_EQ(sectors[i], distance ? distance->to_float() : -1.0F) << i;
    }
    EXPECT_EQ(this->core_->sectors(sectors.data(), 5), 5U);
  } else {
    EXPECT_EQ(count, 0U);
  }
}

TEST(Library, HasWordsForEachAnswerAndLevel) {
  std::set<std::string> all;
  for (int i = 0; i <= FENCEPOST_NULL; ++i) all.insert(text(static_cast<Answer>(i)));
  EXPECT_EQ(all.size(), FENCEPOST_NULL + 1U);
  EXPECT_STREQ(text(Answer::kNoCamera), "boxes came before a camera was set");
  EXPECT_STREQ(text(Level::kBlind), "BLIND");
}

TEST(Library, IsOfTheProjectsVersion) {
  EXPECT_STREQ(kVersion, FENCEPOST_PROJECT_VERSION);
  EXPECT_STREQ(fencepost_version(), FENCEPOST_PROJECT_VERSION);
}

TEST(WideClock, GoesOnWhereTheNarrowOneWraps) {
  WideClock clock;
  EXPECT_EQ(clock.at(0xFFFFFF00U), 0xFFFFFF00LL);
  EXPECT_EQ(clock.at(0x00000100U), 0x100000100LL);
  EXPECT_EQ(clock.at(0x00000100U), 0x100000100LL);
}

}  // namespace
}  // namespace fencepost::test
