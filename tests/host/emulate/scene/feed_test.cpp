#include "host/emulate/scene/feed.hpp"

#include <gtest/gtest.h>

#include "host/scene/load.hpp"
#include "host/simulate/simulate.hpp"
#include "tests/host/contents.hpp"

namespace fencepost::emulate {
namespace {

std::string recording(const std::string& name) {
  return test::contents(FENCEPOST_SOURCE_DIR "/host/share/recordings/" + name);
}

TEST(Feed, OfASceneIsThatOfItsLog) {
  const auto scene = host::parse_scene(recording("approach_stop.json"), "scene");
  ASSERT_TRUE(scene.ok());
  const Feed of_scene = feed_from_scene(*scene);
  const Feed of_log = feed_from_log(recording("approach_stop.log"), "log");
  EXPECT_EQ(of_scene.problem, "");
  EXPECT_GT(of_scene.frames.size(), 50U);
  EXPECT_GT(of_scene.poses.size(), 200U);
  EXPECT_EQ(of_scene.frames, of_log.frames);
  EXPECT_EQ(of_scene.poses, of_log.poses);
  EXPECT_EQ(of_scene.camera, of_log.camera);
  EXPECT_EQ(of_scene.signatures, of_log.signatures);
  EXPECT_EQ(of_scene.colour_of(1), (sensor::Rgb{0xd0, 0x20, 0x20}));
  EXPECT_FALSE(of_scene.colour_of(9));
  EXPECT_EQ(of_scene.begin(), base::Time{});
  EXPECT_EQ(of_scene.end(), of_scene.poses.back().t);
}

TEST(Feed, PlaysTheFirstRunOfALogOnly) {
  const std::string log = recording("approach_stop.log");
  const Feed once = feed_from_log(log, "log");
  const Feed twice = feed_from_log(log + log, "log");
  EXPECT_EQ(twice.frames, once.frames);
  EXPECT_EQ(twice.poses, once.poses);
  ASSERT_EQ(twice.notes.size(), 1U);
  EXPECT_NE(twice.notes[0].find("only the first is played"), std::string::npos);
}

TEST(Feed, SaysWhatCannotBePlayed) {
  EXPECT_NE(feed_from_log("", "log").problem, "");
  EXPECT_NE(feed_from_log("hello\nworld\n", "log").problem.find("no frame"), std::string::npos);
  const Feed damaged = feed_from_log(recording("approach_stop.log") + "$FPODO,x*0000\n", "log");
  EXPECT_EQ(damaged.problem, "");
  ASSERT_EQ(damaged.notes.size(), 1U);
  EXPECT_NE(damaged.notes[0].find("1 line(s) rejected"), std::string::npos);
  host::Scene scene;
  EXPECT_NE(feed_from_scene(scene).problem.find("path"), std::string::npos);
}

}  // namespace
}  // namespace fencepost::emulate
