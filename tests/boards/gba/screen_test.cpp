// The Game Boy Advance's pictures and buttons.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "firmware/recon/models/hybrid/hybrid.hpp"
#include "firmware/view/palette.hpp"
#include "host/geometry/rings.hpp"
#include "host/replay/replay.hpp"
#include "tests/boards/bench.hpp"
#include "tests/boards/gba/board.hpp"

namespace fencepost::test {
namespace {

constexpr double kMetresAPixel = 0.02;  // four steps from the nearest scale
constexpr int kRobotAt = 80;            // both ways, once somebody has zoomed

// The fields of the last record of a kind.
std::vector<std::string> last(const std::string& said, const std::string& start) {
  const std::size_t at = said.rfind(start);
  std::vector<std::string> fields;
  if (at == std::string::npos) return fields;
  std::istringstream line(said.substr(at, said.find('*', at) - at));
  for (std::string field; std::getline(line, field, ',');) fields.push_back(field);
  return fields;
}

// Five bits of each colour are shown.
bool looks_like(Handheld::Pixel pixel, int red, int green, int blue) {
  return std::abs(pixel.red - red) < 9 && std::abs(pixel.green - green) < 9 && std::abs(pixel.blue - blue) < 9;
}
std::string text_of(Handheld::Pixel pixel) {
  return std::to_string(pixel.red) + " " + std::to_string(pixel.green) + " " + std::to_string(pixel.blue);
}

class GbaScreen : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(bench.await("READY\r\n")) << bench.said(); }
  void press(unsigned keys, int times = 1) {
    for (int i = 0; i < times; ++i) {
      machine->hold(keys);
      bench.run(0.4);
      machine->hold(0);
      bench.run(0.4);
    }
  }
  // At the end of a scene, the robot in the middle.
  void take_picture(const host::Scene& scene) {
    const SceneStream stream = stream_of(scene);
    ASSERT_TRUE(bench.start_log(stream));
    bench.play(stream);
    press(Handheld::kA, 7);
    press(Handheld::kB, 3);
    bench.run(1);
    machine->save_picture(picture);
  }
  // Pixels of this colour on the map, on it as points in metres.
  std::vector<host::Point> points_of(sensor::Rgb colour) {
    const auto robot = last(bench.said(), "$FPODO,");
    std::vector<host::Point> points;
    for (int y = 0; y < 2 * kRobotAt; ++y) {
      for (int x = 0; x < 2 * kRobotAt; ++x) {
        const auto pixel = machine->pixel(static_cast<std::size_t>(x), static_cast<std::size_t>(y));
        if (!looks_like(pixel, colour.red, colour.green, colour.blue)) continue;
        points.push_back({std::stod(robot.at(2)) + (kRobotAt - y) * kMetresAPixel,
                          std::stod(robot.at(3)) + (kRobotAt - x) * kMetresAPixel});
      }
    }
    return points;
  }

  const std::string picture = ::testing::TempDir() + "fencepost-gba.png";
  Handheld* machine = nullptr;
  Bench bench{gba(&machine)};
};

TEST_F(GbaScreen, ShowsObjectsWhereTheyAre) {
  ASSERT_NO_FATAL_FAILURE(take_picture(recorded_scene("blocks_arc")));
  const auto robot = last(bench.said(), "$FPODO,");
  ASSERT_EQ(robot.size(), 5U);
  int compared = 0;
  for (int id = 1; id < 10; ++id) {
    std::vector<std::string> object;
    for (std::size_t at = 0; (at = bench.said().find("$FPOBJ,", at)) != std::string::npos; ++at) {
      auto fields = last(bench.said().substr(at, 200), "$FPOBJ,");
      if (fields.size() > 7 && fields[2] == std::to_string(id)) object = fields;
    }
    if (object.empty()) continue;
    const auto signature = last(bench.said(), "$FPSIG," + object[3] + ",");
    ASSERT_GE(signature.size(), 3U);
    const long rgb = std::stol(signature[2], nullptr, 16);
    const auto x = std::lround(kRobotAt - (std::stod(object[6]) - std::stod(robot[3])) / kMetresAPixel);
    const auto y = std::lround(kRobotAt - (std::stod(object[5]) - std::stod(robot[2])) / kMetresAPixel);
    if (x < 5 || x > 155 || y < 5 || y > 155) continue;
    const auto pixel = machine->pixel(static_cast<std::size_t>(x), static_cast<std::size_t>(y));
    EXPECT_TRUE(looks_like(pixel, static_cast<int>(rgb >> 16), static_cast<int>((rgb >> 8) & 0xFF),
                           static_cast<int>(rgb & 0xFF)))
        << "object " << id << " at " << x << ", " << y << ": " << text_of(pixel) << "; " << picture;
    ++compared;
  }
  EXPECT_GE(compared, 2);
  EXPECT_TRUE(looks_like(machine->pixel(kRobotAt, kRobotAt), 248, 248, 248)) << picture;
}

// m, along an axis.
double size_of(const host::Polygon& polygon) {
  const auto [left, right] = std::ranges::minmax(polygon.outer, {}, &host::Point::x);
  const auto [low, high] = std::ranges::minmax(polygon.outer, {}, &host::Point::y);
  return std::max(right.x - left.x, high.y - low.y);
}

// The desk's replay of the same run has the outlines. Well-known objects are drawn as one, with a lighter edge. Those
// of less than four pixels of radius are not; the can is one.
TEST_F(GbaScreen, DrawsOutlinesThatAreKnownWell) {
  ASSERT_NO_FATAL_FAILURE(take_picture(recorded_scene("blocks_arc")));
  const host::ReplayOutcome run = host::replay(bench.said().substr(bench.said().find("$FPHDR")), "console", {});
  const double known_well = 1 - std::sqrt(double{recon::kWellKnownShare});  // as a confidence
  int outlined = 0;
  for (const host::ObjectResult& object : run.result.objects) {
    const auto signature = std::ranges::find(run.result.signatures, object.signature, &record::Signature::signature);
    const auto hybrid = std::ranges::find(object.models, "hybrid", &host::ModelResult::name);
    ASSERT_TRUE(signature != run.result.signatures.end() && hybrid != object.models.end());
    ASSERT_EQ(hybrid->geometry.size(), 1U);
    const host::Polygon& outline = hybrid->geometry.front();
    const bus::Colour edge = view::lighter({signature->rgb.red, signature->rgb.green, signature->rgb.blue});
    std::vector<host::Point> points = points_of({edge.red, edge.green, edge.blue});
    EXPECT_EQ(!points.empty(), object.confidence > known_well && size_of(outline) >= 8 * kMetresAPixel)
        << signature->name.view() << "; " << picture;
    if (points.empty()) continue;
    ++outlined;
    const std::vector<host::Point> inside = points_of(signature->rgb);
    points.insert(points.end(), inside.begin(), inside.end());
    for (const host::Point& point : points) {
      const bool near = host::distance_to_outline(point, outline.outer) < 2 * kMetresAPixel;
      EXPECT_TRUE(near || host::contains(outline, point))
          << signature->name.view() << " at " << point.x << ", " << point.y << "; " << picture;
    }
    EXPECT_GT(static_cast<double>(points.size()), host::area(outline) / (kMetresAPixel * kMetresAPixel)) << picture;
  }
  EXPECT_EQ(outlined, 2) << picture;
}

TEST_F(GbaScreen, ShowsTheAlertLevel) {
  const SceneStream stream = stream_of(recorded_scene("approach_stop"));
  EXPECT_TRUE(looks_like(machine->pixel(163, 3), 0, 0, 0));
  ASSERT_TRUE(bench.start_log(stream));
  bench.run(0.5);
  EXPECT_TRUE(looks_like(machine->pixel(163, 3), 40, 160, 88)) << text_of(machine->pixel(163, 3));
  bench.play(stream);
  bench.run(0.5);
  const auto alert = last(bench.said(), "$FPALR,");
  ASSERT_GE(alert.size(), 3U);
  ASSERT_EQ(alert[2], "stop");
  EXPECT_TRUE(looks_like(machine->pixel(163, 3), 248, 56, 40)) << text_of(machine->pixel(163, 3));
}

TEST_F(GbaScreen, ObeysItsButtons) {
  EXPECT_TRUE(bench.obey("status", "mode text")) << bench.said();
  press(Handheld::kStart);
  EXPECT_TRUE(bench.obey("status", "mode log")) << bench.said();
  const SceneStream stream = stream_of(recorded_scene("approach_stop"));
  ASSERT_TRUE(bench.start_log(stream));
  bench.play(stream);
  EXPECT_TRUE(bench.obey("status", "objects 2 of 8")) << bench.said();
  press(Handheld::kSelect);
  EXPECT_TRUE(bench.obey("status", "objects 0 of 8")) << bench.said();
  press(Handheld::kStart, 2);
  EXPECT_TRUE(bench.obey("status", "mode quiet")) << bench.said();
}

}  // namespace
}  // namespace fencepost::test
