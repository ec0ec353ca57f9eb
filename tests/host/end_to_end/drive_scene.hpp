// A drive of six seconds towards a red block, past nothing, with a yellow post behind it; and the bounds of its
// results.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "host/devices/open_devices.hpp"
#include "tests/host/cli/process.hpp"

namespace fencepost::host::testing {

struct Thing {
  int signature;
  const char* name;
  double x;     ///< m, middle of its footprint
  double y;     ///< m
  double half;  ///< m, half of its greatest extent: a cylinder's middle lies within
};

inline constexpr double kEnd = 1.58;  ///< m, where the robot stops: 0.22 m before the block
inline const std::vector<Thing> kThings = {{1, "red", 1.86, -0.01, 0.06}, {2, "yellow", 2.3, 0.22, 0.04}};

/// The camera as its driver knows it, 0.12 m above the floor and 0.05 m before the robot's middle.
inline sensor::CameraIntrinsics camera_of(const std::string& device) {
  const auto spec = devices::parse_device(device, devices::Use::kCamera);
  EXPECT_TRUE(spec.ok()) << spec.error();
  const auto profile = devices::profile_of(*spec);
  EXPECT_TRUE(profile.has_value()) << device;
  return profile.value_or(sensor::CameraIntrinsics{});
}

/// It starts straight ahead, so that the map frame is the world of wheels that count from zero. It turns twice, for a
/// baseline across it. It turns slowly, because bytes on their way add to the latency that the calibration knows: 0.1 s
/// at 0.4 rad/s are 2 degrees. `speed`: m/s.
inline std::string scene_for(const sensor::CameraIntrinsics& camera, double rate, double speed) {
  nlohmann::json scene = nlohmann::json::parse(R"({"format": 1, "seed": 1, "robot": {"width": 0.2},
    "signatures": [{"id": 1, "name": "red", "rgb": "d02020"}, {"id": 2, "name": "yellow", "rgb": "d8c020"}],
    "objects": [
      {"name": "block", "signature": 1, "height": 0.1, "footprint": {"type": "Polygon", "coordinates":
        [[[1.8, -0.06], [1.9, -0.07], [1.92, 0.04], [1.82, 0.05], [1.8, -0.06]]]}},
      {"name": "post", "signature": 2, "height": 0.3, "footprint": {"circle": [2.3, 0.22, 0.04]}}],
    "path": {"type": "waypoints", "points": [[0, 0], [0.3, 0], [0.7, 0.06], [1.1, -0.04], [1.58, 0]], "turn_rate": 0.4}})");
  scene["path"]["speed"] = speed;
  scene["camera"] = {{"model", std::string(camera.model.view())},
                     {"width", camera.width},
                     {"height", camera.height},
                     {"fx", camera.fx.to_double()},
                     {"fy", camera.fy.to_double()},
                     {"cx", camera.cx.to_double()},
                     {"cy", camera.cy.to_double()},
                     {"k1", 0},
                     {"mount", {{"x", 0.05}, {"y", 0}, {"z", 0.12}, {"yaw", 0}, {"pitch", 0}}},
                     {"latency", 0.05},
                     {"rate", rate},
                     {"max_blobs", 16}};
  return scene.dump();
}

/// The maximum error of an object's place, m. It is two pixels of width and of its foot's row, at the nearest distance
/// from which the foot is seen. Half of its size comes on top, since only its front is seen. `odometry`: the base's
/// error, in shares of the way.
inline double bound_of(const Thing& thing, const sensor::CameraIntrinsics& camera, double odometry) {
  constexpr double kPixels = 2;
  const double foot = camera.fy.to_double() * 0.12;  // px m: the row below the horizon is this over the distance
  const double distance = std::max(std::hypot(thing.x - kEnd - 0.05, thing.y), foot / (camera.height / 2.0 - 2));
  const double row = kPixels * distance * distance / foot;
  const double column = kPixels * distance / camera.fx.to_double();
  return std::hypot(row, column) + thing.half + odometry * thing.x;
}

/// The log agrees with its replay, which has the run's digest.
inline void expect_replays(const Folder& folder, const std::string& run_err) {
  const Outcome replay = shell(folder, "fencepost replay --check run.log");
  EXPECT_EQ(replay.exit_code, 0) << replay.err;
  EXPECT_EQ(digest_in(replay.out), digest_in(run_err));
}

/// The objects of the log's map. `boxes`: the camera reports them. One that reports areas makes the tall post seem
/// nearer than it is. A few milliseconds then decide whether the first guess is corrected, or lost and begun anew.
inline nlohmann::json believed(const Folder& folder, bool boxes) {
  constexpr double kGivenUp = 0.2;  // confidence
  const Outcome replay = shell(folder, "fencepost replay --json run.log");
  EXPECT_EQ(replay.exit_code, 0) << replay.err;
  nlohmann::json objects = nlohmann::json::parse(replay.out).at("objects");
  const auto given_up = [](const nlohmann::json& object) {
    return object["state"] == "lost" && object["confidence"] < kGivenUp;
  };
  if (!boxes) objects.erase(std::remove_if(objects.begin(), objects.end(), given_up), objects.end());
  return objects;
}

/// One confirmed object for each thing, within its bound, and nothing else. Without boxes no foot is seen: the place
/// may be off by a tenth of the way more.
inline void expect_things(const Folder& folder, const sensor::CameraIntrinsics& camera, double odometry,
                          bool boxes = true) {
  const nlohmann::json objects = believed(folder, boxes);
  EXPECT_EQ(objects.size(), kThings.size()) << objects.dump(1);
  for (const Thing& thing : kThings) {
    const auto found = std::find_if(objects.begin(), objects.end(),
                                    [&](const auto& object) { return object["signature"] == thing.signature; });
    ASSERT_NE(found, objects.end()) << thing.name;
    // Lost is what was confirmed and is not seen at the moment: the drive is over.
    EXPECT_NE((*found)["state"], "tentative") << thing.name;
    const nlohmann::json& cylinder = (*found)["models"]["cylinder"];
    ASSERT_TRUE(cylinder["x"].is_number()) << thing.name;
    const double error = std::hypot(cylinder["x"].get<double>() - thing.x, cylinder["y"].get<double>() - thing.y);
    const double bound = bound_of(thing, camera, odometry) + (boxes ? 0.0 : 0.1 * thing.x);
    EXPECT_LT(error, bound) << thing.name << " at " << cylinder["x"] << ", " << cylinder["y"];
    ::testing::Test::RecordProperty(thing.name, std::to_string(error) + " of " + std::to_string(bound) + " m");
  }
}

}  // namespace fencepost::host::testing
