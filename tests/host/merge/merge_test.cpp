// Maps of several runs as one.
#include "host/merge/merge.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "host/merge/move.hpp"
#include "host/result/lookup.hpp"

namespace fencepost::host {
namespace {

struct Thing {
  double x = 0;
  double y = 0;
  std::uint8_t signature = 1;
};

/// The map of a run whose frame lies at `frame` in that of the things. Objects are squares.
RunMap run(const std::string& name, const Motion& frame, const std::vector<Thing>& things, std::uint32_t views = 50) {
  RunMap map;
  map.log = name;
  map.result.profile = "full";
  map.result.digest = views;
  map.result.log.frames = 100;
  for (const Thing& thing : things) {
    const Point away = {thing.x - frame.shift.x, thing.y - frame.shift.y};
    const Point seen = {frame.rotation.x * away.x + frame.rotation.y * away.y,
                        frame.rotation.x * away.y - frame.rotation.y * away.x};
    ObjectResult object;
    object.id = static_cast<std::uint32_t>(10 + map.result.objects.size());
    object.signature = thing.signature;
    object.state = record::ObjectState::kConfirmed;
    object.views = views;
    object.sigma = 0.01;
    object.confidence = 0.5;
    ModelResult model;
    model.name = "cylinder";
    model.circle = Circle{seen, 0.05};
    model.geometry = {Polygon{{{seen.x - 0.05, seen.y - 0.05},
                               {seen.x + 0.05, seen.y - 0.05},
                               {seen.x + 0.05, seen.y + 0.05},
                               {seen.x - 0.05, seen.y + 0.05}},
                              {}}};
    object.models = {model};
    map.result.objects.push_back(object);
  }
  map.result.path = {{0, 0, 0, 0}, {1, 1, 0, 0}};
  map.result.guard = {{1, 0, 3}};
  map.result.signatures = {{1, {0xd0, 0x20, 0x20}, "red"}};
  return map;
}
Motion at(double degrees, double x, double y) {
  return {{std::cos(degrees / 57.29577951), std::sin(degrees / 57.29577951)}, {x, y}};
}

const std::vector<Thing> kRoom = {{0, 0}, {2, 0.3}, {1.1, 2.4}, {-1.7, 1.0}, {3.1, 1.9}, {0.4, -2.2}, {-2.5, -1.5}};
std::vector<Thing> some(std::initializer_list<std::size_t> which) {
  std::vector<Thing> things;
  for (const std::size_t one : which) things.push_back(kRoom[one]);
  return things;
}
Point place(const MergedMap& merged, std::size_t object) { return object_circle(merged.map.objects[object])->center; }

TEST(Merge, AllThingsOnceInTheFirstRunsFrame) {
  const MergedMap merged = merge({run("a.log", at(0, 0, 0), some({0, 1, 2, 3, 4, 5}), 50),
                                  run("b.log", at(115, 2, -1), some({6, 5, 4, 3, 2, 1}), 80)});
  ASSERT_EQ(merged.map.objects.size(), 7U);
  ASSERT_TRUE(merged.runs[1].joined());
  EXPECT_EQ(merged.runs[1].matched, 5U);
  EXPECT_NEAR(merged.runs[1].frame.x, 2, 1e-3);
  EXPECT_NEAR(merged.runs[1].frame.y, -1, 1e-3);
  EXPECT_NEAR(merged.runs[1].frame.heading * 57.29577951, 115, 0.1);
  for (std::size_t i = 0; i < kRoom.size(); ++i) {
    EXPECT_NEAR(place(merged, i).x, kRoom[i].x, 1e-3) << i;
    EXPECT_NEAR(place(merged, i).y, kRoom[i].y, 1e-3) << i;
    EXPECT_EQ(merged.map.objects[i].id, i + 1);
  }
  EXPECT_EQ(merged.sources[0].size(), 1U) << "the second run did not see it";
  ASSERT_EQ(merged.sources[5].size(), 2U);
  EXPECT_EQ(merged.sources[5][1].run, 1U);
  EXPECT_EQ(merged.sources[5][1].id, 11U);
  EXPECT_EQ(merged.map.objects[5].views, 130U);
  EXPECT_EQ(merged.map.log.frames, 200U);
  ASSERT_EQ(merged.map.path.size(), 4U);
  EXPECT_NEAR(merged.map.path[3].x, 2 + std::cos(115 / 57.29577951), 1e-3) << "a metre along its first heading";
  ASSERT_EQ(merged.map.guard.size(), 2U);
  EXPECT_NEAR(merged.map.guard[1].y, -1 + std::sin(115 / 57.29577951), 1e-3);
}

// A square's sides turn with it: the better seen one's model is kept.
TEST(Merge, ModelsTurnWithTheirRun) {
  const MergedMap merged = merge({run("a.log", at(0, 0, 0), kRoom, 50), run("b.log", at(45, 1, 1), kRoom, 80)});
  const Polygon& square = merged.map.objects[0].models[0].geometry[0];
  EXPECT_NEAR(std::hypot(square.outer[0].x - place(merged, 0).x, square.outer[0].y - place(merged, 0).y), 0.0707, 1e-3);
  EXPECT_NEAR(square.outer[0].x, place(merged, 0).x, 1e-3) << "a corner is below the middle now";
}

TEST(Merge, PlacesAreTheMeanByTheirSigmas) {
  std::vector<Thing> off = kRoom;
  off[0].x += 0.03;
  RunMap second = run("b.log", at(0, 0, 0), off);
  for (ObjectResult& object : second.result.objects) object.sigma = 0.02;
  const MergedMap merged = merge({run("a.log", at(0, 0, 0), kRoom), second});
  EXPECT_NEAR(place(merged, 0).x, 0.03 / 5, 0.003) << "a fifth, of which the motion takes some";
  EXPECT_LT(merged.map.objects[0].sigma, 0.01);
}

TEST(Merge, ARunThatFitsByAnotherOnesMapJoinsAfterIt) {
  const auto coloured = [](std::initializer_list<std::size_t> which) {
    std::vector<Thing> things = some(which);
    std::size_t n = 0;
    for (const std::size_t one : which) things[n++].signature = static_cast<std::uint8_t>(1 + one);
    return things;
  };
  const RunMap a = run("a.log", at(0, 0, 0), coloured({0, 1, 2, 3, 4}));
  const RunMap b = run("b.log", at(115, 2, -1), coloured({1, 2, 3, 4, 5, 6}));
  const RunMap c = run("c.log", at(-60, 5, 5), coloured({2, 4, 5, 6}));
  EXPECT_EQ(merge({a, c}).runs[1].verdict, recon::JoinVerdict::kTooFew) << "two in common";
  const MergedMap merged = merge({a, c, b});
  EXPECT_TRUE(merged.runs[1].joined());
  EXPECT_TRUE(merged.runs[2].joined());
  EXPECT_NEAR(merged.runs[1].frame.x, 5, 1e-3);
  EXPECT_EQ(merged.map.objects.size(), 7U);
}

TEST(Merge, StaysOutWhereItIsNotSure) {
  const std::vector<Thing> square = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  const MergedMap equal = merge({run("a.log", at(0, 0, 0), square), run("b.log", at(20, 1, 1), square)});
  EXPECT_EQ(equal.runs[1].verdict, recon::JoinVerdict::kAmbiguous);
  EXPECT_NE(reason(equal.runs[1]).find("more than one way"), std::string::npos);
  EXPECT_EQ(equal.map.objects.size(), 4U) << "the first run's alone";
  const MergedMap few = merge({run("a.log", at(0, 0, 0), kRoom), run("b.log", at(0, 0, 0), some({0, 1}))});
  EXPECT_EQ(few.runs[1].verdict, recon::JoinVerdict::kTooFew);
  RunMap vague = run("b.log", at(0, 0, 0), kRoom);
  for (ObjectResult& object : vague.result.objects) object.views = 2;
  EXPECT_EQ(merge({run("a.log", at(0, 0, 0), kRoom), vague}).runs[1].objects, 0U);
}

TEST(Merge, SaysWhereOneNumberHasTwoNames) {
  RunMap other = run("b.log", at(0, 0, 0), kRoom);
  other.result.signatures = {{1, {0, 0, 0xd0}, "blue"}};
  const MergedMap merged = merge({run("a.log", at(0, 0, 0), kRoom), other});
  ASSERT_EQ(merged.notes.size(), 1U);
  EXPECT_NE(merged.notes[0].find("\"red\""), std::string::npos);
}

TEST(Merge, TextAndJsonSayWhatWasJoined) {
  const std::vector<Thing> square = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  const MergedMap merged =
      merge({run("a.log", at(0, 0, 0), kRoom), run("b.log", at(90, 2, -1), kRoom), run("c.log", at(0, 0, 0), square)});
  const std::string text = merge_text(merged, false);
  EXPECT_NE(text.find("b.log: begins at x 2.000 m, y -1.000 m, heading 90.0 deg, by 7 objects"), std::string::npos)
      << text;
  EXPECT_NE(text.find("c.log: left out: "), std::string::npos) << text;
  const auto json = nlohmann::json::parse(merge_json(merged));
  EXPECT_EQ(json["objects"].size(), 7U);
  EXPECT_EQ(json["objects"][0]["sources"].size(), 2U);
  EXPECT_EQ(json["objects"][0]["id"], 1);
  EXPECT_EQ(json["runs"][1]["verdict"], "joined");
  EXPECT_NEAR(json["runs"][1]["x"].get<double>(), 2, 1e-3);
  EXPECT_TRUE(json["runs"][2]["x"].is_null());
  for (const char* key : {"format", "log", "digest", "profile", "pose", "alerts", "guard", "calibration"})
    EXPECT_TRUE(json.contains(key)) << key;
}

}  // namespace
}  // namespace fencepost::host
