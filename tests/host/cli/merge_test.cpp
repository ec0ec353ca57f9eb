// `fencepost merge`: two robots in one room, whose maps begin elsewhere.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/host/cli/run.hpp"

namespace fencepost::host::cli {
namespace {

using namespace testing;

struct Place {
  double x = 0;
  double y = 0;
};

/// Six posts in a room, seen from an arc about its middle. `turned`: the map frame is turned by 90 degrees to the left
/// of the other one and lies at (3, -1).
std::string scene(bool turned, int seed, double start, int colours = 2) {
  const auto at = [turned](Place p) { return turned ? Place{p.y + 1, 3 - p.x} : p; };
  const Place posts[] = {{0.5, 0.1}, {-0.6, 0.3}, {0.1, -0.55}, {-0.2, 0.7}, {0.75, 0.6}, {-0.65, -0.4}};
  nlohmann::json objects = nlohmann::json::array();
  int n = 0;
  for (const Place& post : posts) {
    const Place p = at(post);
    objects.push_back({{"name", fmt::format("post {}", n)},
                       {"signature", 1 + n % colours},
                       {"height", 0.3},
                       {"footprint", {{"circle", {p.x, p.y, 0.04}}}}});
    ++n;
  }
  const Place middle = at({0, 0});
  const nlohmann::json camera = {
      {"model", "pixy2"}, {"width", 316},    {"height", 208},
      {"fx", 273.6},      {"fy", 273.6},     {"cx", 157.5},
      {"cy", 103.5},      {"k1", 0},         {"latency", 0.05},
      {"rate", 10},       {"max_blobs", 16}, {"mount", {{"x", 0.05}, {"y", 0}, {"z", 0.12}, {"yaw", 0}, {"pitch", 0}}}};
  const nlohmann::json path = {{"type", "arc"},      {"center", {middle.x, middle.y}},
                               {"radius", 2.0},      {"start", start},
                               {"sweep", 4.0},       {"views", 90},
                               {"look_at", "center"}};
  nlohmann::json signatures = nlohmann::json::array();
  for (int i = 1; i <= colours; ++i)
    signatures.push_back({{"id", i}, {"name", fmt::format("colour {}", i)}, {"rgb", "d02020"}});
  return nlohmann::json{{"format", 1},
                        {"seed", seed},
                        {"camera", camera},
                        {"robot", {{"width", 0.2}}},
                        {"signatures", signatures},
                        {"objects", objects},
                        {"path", path},
                        {"noise", {{"edge_px", 0.8}, {"pose_xy", 0.003}, {"pose_heading", 0.004}}}}
      .dump();
}

struct Merge : ::testing::Test {
  Folder folder;
  void SetUp() override {
    spill(folder.path() / "a.json", scene(false, 11, 0));
    spill(folder.path() / "b.json", scene(true, 12, 1.5));
    for (const char* one : {"a", "b"}) {
      const Outcome run = shell(folder, fmt::format("fencepost simulate {0}.json -o {0}.log", one));
      ASSERT_EQ(run.exit_code, 0) << run.err;
    }
  }
};

TEST_F(Merge, PutsTwoRobotsIntoOneMap) {
  const Outcome run = shell(folder, "fencepost merge a.log b.log --json");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json["objects"].size(), 6U);
  const auto& joined = json["runs"][1];
  EXPECT_NEAR(joined["x"].get<double>(), 3, 0.03) << joined;
  EXPECT_NEAR(joined["y"].get<double>(), -1, 0.03);
  EXPECT_NEAR(joined["heading"].get<double>(), 1.5708, 0.03);
  EXPECT_EQ(joined["matched"], 6);
  EXPECT_NE(shell(folder, "fencepost merge a.log b.log").out.find("b.log: begins at x "), std::string::npos);
}

// A robot that was carried to where its odometry begins anew.
TEST_F(Merge, JoinsTheRunsOfOneLog) {
  const Outcome run = shell(folder, "cat a.log b.log > both.log; fencepost merge both.log --json");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  ASSERT_EQ(json["runs"].size(), 2U);
  EXPECT_EQ(json["runs"][1]["log"], "both.log, run 2");
  EXPECT_NEAR(json["runs"][1]["x"].get<double>(), 3, 0.03);
  EXPECT_EQ(json["objects"].size(), 6U);
}

// Half a second is no map, but six known posts of own colours are in sight.
TEST_F(Merge, SaysWhereAShortRunBegins) {
  spill(folder.path() / "d.json", scene(false, 11, 0, 6));
  spill(folder.path() / "e.json", scene(true, 12, 1.5, 6));
  ASSERT_EQ(
      shell(folder, "for n in d e; do fencepost simulate $n.json -o $n.log; done; head -n 40 e.log > f.log").exit_code,
      0);
  const Outcome run = shell(folder, "fencepost merge d.log f.log --json");
  EXPECT_EQ(run.exit_code, 1) << "its objects are not in the map";
  const auto json = nlohmann::json::parse(run.out);
  const auto& start = json["runs"][1]["start"];
  ASSERT_TRUE(start.is_object()) << json["runs"];
  EXPECT_NEAR(start["x"].get<double>(), 3, 0.1);
  EXPECT_NEAR(start["y"].get<double>(), -1, 0.1);
  EXPECT_NEAR(start["heading"].get<double>(), 1.5708, 0.05);
  EXPECT_LT(start["after"].get<double>(), 1);
  EXPECT_NE(shell(folder, "fencepost merge d.log f.log").out.find("  it begins at x "), std::string::npos);
  EXPECT_TRUE(
      nlohmann::json::parse(shell(folder, "fencepost merge a.log b.log --json").out)["runs"][1]["start"].is_null());
}

TEST_F(Merge, JoinsTheOthersWhereOneLogCannotBeRead) {
  const Outcome run =
      shell(folder, "echo foreign > foreign.log; fencepost merge a.log no.log foreign.log b.log --json");
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_TRUE(holds(run.err, "left out: cannot read no.log"));
  EXPECT_TRUE(holds(run.err, "left out: foreign.log: no record"));
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json["runs"].size(), 2U);
  EXPECT_EQ(json["objects"].size(), 6U);
  EXPECT_EQ(shell(folder, "fencepost merge no.log foreign.log").exit_code, 3);
  EXPECT_TRUE(ends(shell(folder, ": > empty.log; fencepost merge empty.log"), 3, "empty.log: empty; record"));
  EXPECT_TRUE(ends(shell(folder, "fencepost merge a.log empty.log b.log"), 3, "left out: empty.log: empty"));
}

TEST_F(Merge, SaysWhatStaysOut) {
  const Outcome run = shell(folder, "head -n 20 b.log > c.log; fencepost merge a.log c.log");
  EXPECT_EQ(run.exit_code, 1) << run.out;
  EXPECT_TRUE(holds(run.err, "c.log is not in the map: "));
  EXPECT_TRUE(holds(run.out, "c.log: left out: "));
  EXPECT_EQ(shell(folder, "fencepost merge - a.log -").exit_code, 2);
}

}  // namespace
}  // namespace fencepost::host::cli
