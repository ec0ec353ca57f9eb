#include "host/web/drive.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "host/replay/replay.hpp"
#include "host/scene/load.hpp"
#include "tests/text.hpp"

namespace fencepost::host {
namespace {

using test::count;

Scene room(const std::string& objects, const std::string& more = "") {
  const auto scene = parse_scene(R"({"format": 1, "seed": 3,
    "camera": {"model": "pixy2", "width": 316, "height": 208, "fx": 273.6, "fy": 273.6, "cx": 157.5, "cy": 103.5,
               "mount": {"x": 0.05, "z": 0.12, "pitch": 0}, "latency": 0.05, "rate": 20},
    "robot": {"width": 0.2}, "signatures": [{"id": 1, "name": "red", "rgb": "d02020"}],
    "objects": [)" + objects + "]" + more +
                                     "}",
                                 "room");
  EXPECT_TRUE(scene.ok()) << (scene.ok() ? "" : scene.error().message());
  return *scene;
}

// Its near side is 1.2 m ahead of the robot's origin.
constexpr const char* kBox = R"({"name": "box", "signature": 1, "height": 0.14, "footprint": {"type": "Polygon",
  "coordinates": [[[1.2, -0.15], [1.4, -0.15], [1.4, 0.15], [1.2, 0.15], [1.2, -0.15]]]}})";

nlohmann::json truth(const Drive& drive) { return nlohmann::json::parse(drive.truth()); }

TEST(Drive, ItsLogReplaysToItsDigest) {
  Drive drive(room(kBox, R"(, "noise": {"edge_px": 1, "drift_scale": 0.05})"));
  for (int i = 0; i < 300; ++i) {
    drive.steer(i % 100 < 60 ? 1 : -0.5, i % 70 < 30 ? 0.7 : -0.4);
    EXPECT_TRUE(drive.advance(0.0333));
    if (i == 150) drive.change(room(""));
  }
  drive.finish();
  const ReplayOutcome desk = replay(drive.log(), "drive", {});
  ASSERT_FALSE(desk.unreadable);
  EXPECT_GT(desk.result.log.frames, 150U);
  EXPECT_GT(desk.result.alerts.size(), 2U);
  EXPECT_EQ(desk.result.digest, drive.page().log().now(false).digest);
}

TEST(Drive, StopsBeforeABoxIfItObeysAndBumpsIntoItIfNot) {
  for (const bool obeys : {true, false}) {
    Drive drive(room(kBox));
    drive.obey(obeys);
    drive.steer(1, 0);
    drive.advance(6);
    const auto now = truth(drive);
    EXPECT_EQ(now.at("bumps"), obeys ? 0 : 1);
    EXPECT_EQ(now.at("held"), obeys);
    EXPECT_EQ(now.at("speed"), 0);
    // Its front is 0.1 m ahead of its origin: against the box at 1.1 m.
    const double x = now.at("pose").at(0);
    EXPECT_LE(x, 1.1);
    EXPECT_GT(x, obeys ? 0.7 : 1.09);
    const auto state = nlohmann::json::parse(drive.live().state());
    EXPECT_EQ(state.at("alerts").back().at("level"), "stop");
    EXPECT_TRUE(nlohmann::json::parse(drive.live().state()).at("alerts").empty()) << "alerts come once";
    // Backwards it may go, and away.
    drive.steer(-1, 0);
    drive.advance(1.5);
    EXPECT_LT(truth(drive).at("pose").at(0), x - 0.3);
  }
}

TEST(Drive, KeepsTheCameraThatItWroteWhateverTheTrueOneIs) {
  Drive drive(room(kBox));
  drive.advance(1);
  Scene higher = room(kBox);
  higher.camera.mount.z = base::Metres::nearest(0.2);
  drive.change(higher);
  drive.advance(11);
  EXPECT_GE(count(drive.log(), "$FPCAM"), 2U);
  const std::size_t written = drive.log().find("$FPCAM");
  const std::string camera = drive.log().substr(written, drive.log().find('\n', written) - written);
  EXPECT_EQ(count(drive.log(), "$FPCAM"), count(drive.log(), camera));
}

TEST(Drive, TheWorldChangesOnTheWay) {
  Drive drive(room(""));
  drive.advance(1);
  EXPECT_EQ(drive.page().log().now(false).objects.size(), 0U);
  drive.change(room(kBox));
  drive.advance(1);
  EXPECT_EQ(drive.page().log().now(false).objects.size(), 1U);
}

TEST(Drive, WritesTheBodyThatTheSceneHas) {
  Scene scene = room("");
  scene.robot.footprint = {{0.31, 0.1}, {-0.12, 0.1}, {-0.12, -0.1}, {0.31, -0.1}};
  const Drive drive(scene);
  EXPECT_EQ(count(drive.log(), "$FPCFG,robot.front,0.31*"), 1U);
  EXPECT_EQ(count(drive.log(), "$FPCFG,robot.rear,0.12*"), 1U);
  EXPECT_EQ(drive.page().log().settings()->text(config::Key::kRobotFront).view(), "0.31");
}

TEST(MapScore, ComparesAllOutlinesWithAllThatTheCameraCanReport) {
  // A square of 0.2 m, half of it beside the true one.
  const auto square = [](double x, double side) {
    return Polygon{{{x, 0}, {x + side, 0}, {x + side, side}, {x, side}}, {}};
  };
  Scene scene;
  scene.objects.push_back({"box", 1, 0, 0.2, square(1, 0.2)});
  scene.objects.push_back({"grey", 0, 0, 0.2, square(3, 1)});
  scene.objects.back().trained = false;
  ObjectResult object;
  object.state = record::ObjectState::kConfirmed;
  object.models = {{"hybrid", {square(1.1, 0.2)}, {}, {}}, {"carve", {square(5, 5)}, {}, {}}};
  const MapScore half = map_score({object}, scene, 0);
  EXPECT_NEAR(half.recklessness.value(), 0.5, 1e-9);
  EXPECT_NEAR(half.paranoia.value(), 0.5, 1e-9);
  object.state = record::ObjectState::kTentative;
  const MapScore nothing = map_score({object}, scene, 0);
  EXPECT_EQ(nothing.recklessness, 1.0);
  EXPECT_FALSE(nothing.paranoia);
}

}  // namespace
}  // namespace fencepost::host
