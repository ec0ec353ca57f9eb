// Wide lenses from pixels to a map: the same three blocks as through a lens of 60 degrees, far from the optical axis.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "firmware/record/encode.hpp"
#include "host/evaluate/evaluate.hpp"
#include "host/scene/load.hpp"
#include "host/simulate/simulate.hpp"

namespace fencepost::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr int kSeeds = 4;

/// Three quarters of a circle at 1.2 m around the blocks in 7.5 s; the camera looks `aside` of the middle, degrees.
std::string drive_around(double aside) {
  std::string poses;
  for (int i = 0; i <= 150; ++i) {
    const double angle = 1.5 * std::numbers::pi * i / 150;
    const nlohmann::json pose = {{"t", 0.05 * i},
                                 {"x", 1.2 * std::cos(angle)},
                                 {"y", 1.2 * std::sin(angle)},
                                 {"heading", angle + std::numbers::pi + aside * kDegree}};
    poses += (i == 0 ? "" : ", ") + pose.dump();
  }
  return R"({"type": "poses", "poses": [)" + poses + "]}";
}

// A drive around the blocks, edges off by a pixel. The focal length is the same through every lens: so is what
// a pixel is worth.
host::Scene blocks(unsigned seed, double aside) {
  const std::string text = R"({"format": 1, "seed": 1,
    "camera": {"width": 316, "height": 280, "fx": 273.6, "fy": 273.6, "cx": 157.5, "cy": 139.5,
      "mount": {"x": 0.05, "y": 0, "z": 0.12, "yaw": 0, "pitch": 0}, "latency": 0.05, "rate": 10},
    "robot": {"width": 0.2},
    "signatures": [{"id": 1, "rgb": "d02020"}, {"id": 2, "rgb": "d8c020"}, {"id": 3, "rgb": "20a040"}],
    "objects": [
      {"signature": 1, "height": 0.2, "footprint": {"type": "Polygon", "coordinates":
        [[[0.12, -0.02], [0.27, 0.03], [0.23, 0.15], [0.08, 0.1], [0.12, -0.02]]]}},
      {"signature": 2, "height": 0.16, "footprint": {"type": "Polygon", "coordinates":
        [[[-0.2, -0.12], [0.0, -0.14], [-0.1, 0.03], [-0.2, -0.12]]]}},
      {"signature": 3, "height": 0.14, "footprint": {"circle": [-0.12, 0.22, 0.05]}}],
    "noise": {"edge_px": 1}, "path": )" +
                           drive_around(aside) + "}";
  const host::LoadedScene loaded = host::parse_scene(text, "blocks");
  EXPECT_TRUE(loaded.ok());
  host::Scene scene = *loaded;
  scene.seed = seed;
  return scene;
}

/// `across`: degrees.
host::Scene through_a_fisheye(host::Scene scene, double across) {
  sensor::CameraIntrinsics& camera = scene.camera;
  camera.lens = sensor::Lens::kEquidistant;
  camera.width = static_cast<std::uint16_t>(across * kDegree * camera.fx.to_double());
  camera.cx = base::Pixels2::nearest((camera.width - 1) / 2.0);
  return scene;
}

std::string log_of(const host::Scene& scene) {
  std::string log;
  const auto done = host::simulate(scene, [&](std::string_view line) {
    log += line;
    return true;
  });
  EXPECT_TRUE(done.ok());
  return log;
}

/// The same log by a robot with another camera configured.
std::string told(std::string log, const sensor::CameraIntrinsics& camera) {
  std::array<char, record::kMaxLine> line{};
  const std::size_t size = record::encode(camera, line);
  for (std::size_t at = log.find("$FPCAM"); at != std::string::npos; at = log.find("$FPCAM", at + size)) {
    log.replace(at, log.find('\n', at) + 1 - at, line.data(), size);
  }
  return log;
}

/// Mean R + P of the hybrid over blocks and seeds, %. A block that was not found has 200.
template <class Lens, class Told>
double mean_sum(double aside, const Lens& lens, const Told& tell) {
  double sum = 0;
  int count = 0;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const host::Scene scene = lens(blocks(seed, aside));
    sensor::CameraIntrinsics camera = scene.camera;
    tell(camera);
    const host::EvaluateOutcome outcome =
        host::evaluate(told(log_of(scene), camera), "fisheye", scene, host::EvaluateOptions{});
    EXPECT_FALSE(outcome.replay.unreadable.has_value());
    for (const host::ObjectEvaluation& object : outcome.evaluation.objects) {
      ++count;
      double here = 200;
      for (const host::ModelScore& model :
           object.cuts.empty() ? std::vector<host::ModelScore>{} : object.cuts.back().models) {
        if (model.model == "hybrid") here = 100 * (model.score.recklessness + model.score.paranoia);
      }
      sum += here;
    }
  }
  EXPECT_EQ(count, 3 * kSeeds);
  return sum / count;
}

void as_it_is(sensor::CameraIntrinsics& /*camera*/) {}

TEST(Fisheye, AMapIsAsGoodAtItsSideAsThroughALensOf60Degrees) {
  const double narrow = mean_sum(
      0, [](host::Scene scene) { return scene; }, as_it_is);
  std::printf("  60 degrees, pinhole: R + P %.1f %%\n", narrow);
  EXPECT_LT(narrow, 15);
  struct Case {
    double across;
    double aside;
  };
  for (const auto& [across, aside] : {Case{120, 0}, {120, 42}, {150, 0}, {150, 57}, {150, -57}}) {
    SCOPED_TRACE(aside);
    const double wide = mean_sum(
        aside, [&](host::Scene scene) { return through_a_fisheye(std::move(scene), across); }, as_it_is);
    std::printf("  %.0f degrees, %.0f aside: R + P %.1f %%\n", across, aside, wide);
    EXPECT_LT(wide, narrow + 3);
  }
}

// The k1 that suits the blocks' bearings best is still no fisheye.
TEST(Fisheye, APinholeWithK1IsNoFisheye) {
  for (const auto& [across, aside, k1] : {std::array{120.0, 42.0, -0.18}, {120.0, 42.0, -0.15}, {150.0, 57.0, -0.14}}) {
    const double sum = mean_sum(
        aside, [&](host::Scene scene) { return through_a_fisheye(std::move(scene), across); },
        [&](sensor::CameraIntrinsics& camera) {
          camera.lens = sensor::Lens::kPinhole;
          camera.k1 = base::Ratio4::nearest(k1);
        });
    std::printf("  %.0f degrees, %.0f aside, configured as a pinhole with k1 %.2f: R + P %.1f %%\n", across, aside, k1,
                sum);
    EXPECT_GT(sum, 30);
  }
}

}  // namespace
}  // namespace fencepost::test
