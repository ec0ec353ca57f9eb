#include "host/scene/load.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

#include "host/geometry/rings.hpp"
#include "tests/host/scene/scenes.hpp"

namespace fencepost::host {
namespace {

TEST(Scene, ReadsEveryPart) {
  const LoadedScene loaded = parse_scene(valid_scene(), "s.json");
  ASSERT_TRUE(loaded.ok()) << loaded.error().message();
  const Scene& scene = *loaded;
  EXPECT_EQ(scene.seed, 5U);
  EXPECT_EQ(scene.camera.model.view(), "pixy2");
  EXPECT_EQ(scene.camera.fx.raw, 27360);
  EXPECT_EQ(scene.camera.mount.yaw.raw, 1000);
  ASSERT_TRUE(scene.camera.mount.pitch.has_value());
  EXPECT_EQ(scene.camera.latency.raw, 500);
  EXPECT_EQ(scene.robot.width, 0.25);
  ASSERT_EQ(scene.signatures.size(), 2U);
  EXPECT_EQ(scene.signatures[0].rgb, (sensor::Rgb{0xd0, 0x20, 0x20}));
  ASSERT_EQ(scene.objects.size(), 2U);
  EXPECT_EQ(scene.objects[0].footprint.outer.size(), 4U) << "the closing corner is not kept";
  EXPECT_EQ(scene.objects[1].footprint.outer.size(), 256U);
  const auto& arc = std::get<ArcPath>(scene.path);
  EXPECT_EQ(arc.views, 75);
  EXPECT_FALSE(arc.look_outwards);
  EXPECT_EQ(scene.noise.edge_px, 1.5);
  EXPECT_EQ(scene.noise.edge_bias_px, 2);
  EXPECT_EQ(scene.noise.loss_max, 0.5) << "default";
}

TEST(Scene, OpenAndClockwiseRingsAreNormalised) {
  const std::string text =
      replaced(valid_scene(), "[[[1,0],[1.1,0],[1.1,0.1],[1,0.1],[1,0]]]", "[[[1,0],[1,0.1],[1.1,0.1],[1.1,0]]]");
  const LoadedScene loaded = parse_scene(text, "s");
  ASSERT_TRUE(loaded.ok());
  EXPECT_EQ(loaded->objects[0].footprint.outer.size(), 4U);
  EXPECT_GT(signed_area(loaded->objects[0].footprint.outer), 0);
}

TEST(Scene, PitchMayBeUnknownAndPathMayBeAbsent) {
  std::string text = replaced(valid_scene(), "\"pitch\": 0", "\"pitch\": null");
  text = replaced(
      text, R"( "path": {"type": "arc", "center": [1.05, 0.05], "radius": 1.2, "start": 0, "sweep": 4.71, "views": 75,
          "look_at": "center"},)",
      "");
  const LoadedScene loaded = parse_scene(text, "s");
  ASSERT_TRUE(loaded.ok()) << loaded.error().message();
  EXPECT_FALSE(loaded->camera.mount.pitch.has_value());
  EXPECT_TRUE(std::holds_alternative<std::monostate>(loaded->path));
}

TEST(Scene, ObjectsMayTouchAndStack) {
  const std::string beside = R"({"name": "can", "signature": 2, "height": 0.1, "footprint": {"type": "Polygon",
      "coordinates": [[[1.1,0],[1.2,0],[1.2,0.1],[1.1,0.1]]]}})";
  const std::string on_top =
      R"({"name": "can", "signature": 2, "base": 0.2, "height": 0.1, "footprint": {"circle": [1.05, 0.05, 0.04]}})";
  for (const std::string& other : {beside, on_top}) {
    const std::string text =
        replaced(valid_scene(),
                 R"({"name": "can", "signature": 2, "height": 0.1, "footprint": {"circle": [2, 0.5, 0.05]}})", other);
    EXPECT_TRUE(parse_scene(text, "s").ok()) << other;
  }
}

TEST(Scene, ObjectsMayMoveComeGoAndBeUntrained) {
  const std::string can = R"({"name": "can", "signature": 2, "height": 0.1, "footprint": {"circle": [2, 0.5, 0.05]}})";
  const std::string ball = R"({"name": "ball", "trained": false, "height": 0.1, "footprint": {"circle": [2, 0.5, 0.05]},
      "path": {"type": "poses", "poses": [{"t": 1, "x": 2, "y": 0.5, "heading": 0}, {"t": 3, "x": 0, "y": 0, "heading": 1}]},
      "from": 0.5, "until": 9})";
  const LoadedScene loaded = parse_scene(replaced(valid_scene(), can, ball), "s");
  ASSERT_TRUE(loaded.ok()) << loaded.error().message();
  const std::string written = write_scene(*loaded);
  const LoadedScene again = parse_scene(written, "s");
  ASSERT_TRUE(again.ok()) << again.error().message();
  EXPECT_EQ(write_scene(*again), written);
  for (const Scene& scene : {*loaded, *again}) {
    EXPECT_TRUE(scene.objects[0].trained);
    EXPECT_TRUE(scene.objects[0].path.empty());
    EXPECT_FALSE(scene.objects[0].from || scene.objects[0].until);
    const SceneObject& object = scene.objects[1];
    EXPECT_FALSE(object.trained);
    ASSERT_EQ(object.path.size(), 2U);
    EXPECT_EQ(object.path[1].t, 3);
    EXPECT_EQ(object.path[1].heading, 1);
    EXPECT_EQ(object.from, 0.5);
    EXPECT_EQ(object.until, 9);
  }
}

TEST(Scene, OnePlaceMayBeTakenAfterAnother) {
  const std::string can = R"({"circle": [2, 0.5, 0.05]}})";
  const std::string box = R"("base": 0, "height": 0.2,)";
  const auto with = [&](const std::string& of_box, const std::string& of_can) {
    return parse_scene(
        replaced(replaced(valid_scene(), box, box + of_box), can, R"({"circle": [1.05, 0.05, 0.02]})" + of_can + "}"),
        "s");
  };
  EXPECT_TRUE(with(R"( "until": 3,)", R"(, "from": 3)").ok());
  EXPECT_TRUE(with(R"( "from": 3,)", R"(, "until": 3)").ok());
  EXPECT_FALSE(with(R"( "until": 3.1,)", R"(, "from": 3)").ok());
}

TEST(Scene, WrittenScenesReadBackTheSame) {
  for (
      const std::string& path :
      {std::string(R"({"type": "waypoints", "points": [[0,0],[1,0.5]], "speed": 0.3, "turn_rate": 0.7})"),
       std::string(
           R"({"type": "poses", "poses": [{"t": 0, "x": 0.1, "y": 0, "heading": 0}, {"t": 1, "x": 1, "y": 0, "heading": 1}]})"),
       std::string(
           R"({"type": "arc", "center": [1, 0], "radius": 2, "sweep": -1, "views": 3, "look_at": "outwards"})")}) {
    std::string text = replaced(
        valid_scene(), R"({"type": "arc", "center": [1.05, 0.05], "radius": 1.2, "start": 0, "sweep": 4.71, "views": 75,
          "look_at": "center"})",
        path);
    const LoadedScene first = parse_scene(text, "s");
    ASSERT_TRUE(first.ok()) << first.error().message();
    const std::string written = write_scene(*first);
    EXPECT_NE(written.find("\"circle\""), std::string::npos);
    const LoadedScene second = parse_scene(written, "s");
    ASSERT_TRUE(second.ok()) << second.error().message();
    EXPECT_EQ(write_scene(*second), written);
    EXPECT_EQ(second->camera, first->camera);
    EXPECT_EQ(second->noise.edge_px, first->noise.edge_px);
    EXPECT_EQ(second->noise.edge_bias_px, first->noise.edge_bias_px);
    EXPECT_EQ(second->path.index(), first->path.index());
  }
}

TEST(Scene, SignaturesMayHaveAPadAndABiasOfTheirOwn) {
  std::string text = replaced(valid_scene(), R"("rgb": "2020d0")", R"("rgb": "2020d0", "pad": -3)");
  text = replaced(text, R"("edge_bias_px": 2)", R"("edge_bias_px": {"2": 3.5})");
  const LoadedScene first = parse_scene(text, "s");
  ASSERT_TRUE(first.ok()) << first.error().message();
  const LoadedScene second = parse_scene(write_scene(*first), "s");
  ASSERT_TRUE(second.ok()) << second.error().message();
  for (const LoadedScene& scene : {first, second}) {
    EXPECT_EQ(scene->signatures[0].pad, 0);
    EXPECT_EQ(scene->signatures[1].pad, -3);
    EXPECT_EQ(scene->noise.edge_bias_px, 0);
    EXPECT_EQ(scene->noise.edge_bias_of, (std::map<std::uint8_t, double>{{2, 3.5}}));
  }
}

TEST(Scene, TheRobotHasEndsOrAFootprint) {
  const auto with = [](const std::string& robot) {
    return parse_scene(replaced(valid_scene(), R"("robot": {"width": 0.25})", "\"robot\": " + robot), "s");
  };
  const LoadedScene ends = with(R"({"front": 0.2, "width": 0.3})");
  ASSERT_TRUE(ends.ok()) << ends.error().message();
  EXPECT_EQ(ends->robot.front, 0.2);
  EXPECT_FALSE(ends->robot.rear.has_value());
  const LoadedScene outline = with(R"({"footprint": [[0.2, 0], [-0.1, 0.1], [-0.1, -0.1]]})");
  ASSERT_TRUE(outline.ok()) << outline.error().message();
  EXPECT_EQ(outline->robot.footprint.size(), 3U);
  for (const LoadedScene& scene : {ends, outline}) {
    const LoadedScene again = parse_scene(write_scene(*scene), "s");
    ASSERT_TRUE(again.ok()) << again.error().message();
    EXPECT_EQ(again->robot.front, scene->robot.front);
    EXPECT_EQ(again->robot.width, scene->robot.width);
    EXPECT_EQ(again->robot.footprint.size(), scene->robot.footprint.size());
  }
}

TEST(SceneFile, IsReadFromDiskAndComplainsByName) {
  const std::string path = testing::TempDir() + "fencepost_scene_load_test.json";
  std::ofstream(path) << valid_scene();
  EXPECT_TRUE(load_scene(path).ok());
  std::remove(path.c_str());
  const LoadedScene missing = load_scene(path);
  ASSERT_FALSE(missing.ok());
  EXPECT_EQ(missing.error().message(), path + ": cannot be read; check the name and the permissions");
  EXPECT_FALSE(load_scene(testing::TempDir()).ok()) << "a folder is not a scene";
}

}  // namespace
}  // namespace fencepost::host
