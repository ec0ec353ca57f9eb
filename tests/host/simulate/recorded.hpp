// A record stream, read back by the robot's own reader.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/record/stream_reader.hpp"
#include "host/simulate/simulate.hpp"
#include "host/simulate/truth.hpp"

namespace fencepost::host {

struct Recorded {
  std::string text;
  std::vector<record::Header> headers;
  std::vector<sensor::CameraIntrinsics> cameras;
  std::vector<record::Signature> signatures;
  std::vector<sensor::OdometrySample> odometry;
  std::vector<sensor::CarSample> cars;
  std::vector<sensor::BlobFrame> frames;
  std::vector<char> order;  ///< H, C, S, O, F as they came
  record::Counts counts;

  void accept(const record::Header& r) { headers.push_back(r), order.push_back('H'); }
  void accept(const sensor::CameraIntrinsics& r) { cameras.push_back(r), order.push_back('C'); }
  void accept(const record::Signature& r) { signatures.push_back(r), order.push_back('S'); }
  void accept(const sensor::OdometrySample& r) { odometry.push_back(r), order.push_back('O'); }
  void accept(const sensor::BlobFrame& r) { frames.push_back(r), order.push_back('F'); }
  void accept(const sensor::CarSample& r) { cars.push_back(r); }
  void accept(const record::Setting&) {}  // of a car
  template <class Other>
  void accept(const Other&) {
    ADD_FAILURE() << "a simulator or importer writes inputs only";
  }
};

inline void expect_box(const sensor::Blob& blob, int x1, int y1, int x2, int y2) {
  EXPECT_EQ(blob.x1, x1);
  EXPECT_EQ(blob.y1, y1);
  EXPECT_EQ(blob.x2, x2);
  EXPECT_EQ(blob.y2, y2);
}

inline Recorded read_back(std::string text) {
  Recorded recorded;
  std::array<char, record::StreamReader::kBuffer> buffer{};
  record::StreamReader reader(buffer);
  reader.push(text, recorded);
  reader.finish();
  recorded.counts = reader.counts();
  EXPECT_EQ(recorded.counts.rejected(), 0U);
  EXPECT_EQ(recorded.counts.foreign, 0U);
  recorded.text = std::move(text);
  return recorded;
}

struct Simulated {
  Recorded log;
  SimulationSummary summary;
  std::vector<FrameTruth> truth;
};

/// Runs the scene and reads its log back; what was recorded must equal what was returned.
inline Simulated run(const Scene& scene) {
  Simulated simulated;
  std::string text;
  const auto result = simulate_with_truth(
      scene, [&](std::string_view line) { text += line; },
      [&](const FrameTruth& truth) { simulated.truth.push_back(truth); });
  EXPECT_TRUE(result.ok()) << (result.ok() ? "" : result.error());
  if (result.ok()) simulated.summary = *result;
  simulated.log = read_back(std::move(text));
  EXPECT_EQ(simulated.log.frames.size(), simulated.truth.size());
  for (std::size_t i = 0; i < simulated.truth.size(); ++i) {
    EXPECT_EQ(simulated.log.frames[i], simulated.truth[i].frame);
    EXPECT_EQ(simulated.truth[i].blobs.size(), simulated.truth[i].frame.blobs.size());
  }
  return simulated;
}

/// Pixy2-like, at the robot's origin, 0.12 m high, no latency.
inline Scene empty_scene() {
  Scene scene;
  scene.camera.model = "pixy2";
  scene.camera.width = 316;
  scene.camera.height = 208;
  scene.camera.fx = base::Pixels2::nearest(273.6);
  scene.camera.fy = base::Pixels2::nearest(273.6);
  scene.camera.cx = base::Pixels2::nearest(157.5);
  scene.camera.cy = base::Pixels2::nearest(103.5);
  scene.camera.mount.z = base::Metres::nearest(0.12);
  scene.camera.mount.pitch = base::Radians{0};
  scene.rate = 50;
  scene.signatures = {{1, "red", {0xd0, 0x20, 0x20}}, {2, "blue", {0x20, 0x20, 0xd0}}, {3, "green", {0, 0xff, 0}}};
  return scene;
}

inline SceneObject box_object(std::uint8_t signature, double x1, double y1, double x2, double y2, double height,
                              double base = 0) {
  return {"box", signature, base, height, {{{x1, y1}, {x2, y1}, {x2, y2}, {x1, y2}}, {}}};
}

/// The robot stands there for `frames` views.
inline PosesPath standing(double x, double y, double heading, int frames = 1, double rate = 50) {
  PosesPath path;
  path.poses.push_back({0, x, y, heading});
  if (frames > 1) path.poses.push_back({(frames - 1) / rate, x, y, heading});
  return path;
}

/// The only blob of the only frame.
inline sensor::Blob only_blob(const Scene& scene) {
  const Simulated simulated = run(scene);
  EXPECT_EQ(simulated.log.frames.size(), 1U);
  if (simulated.log.frames.size() != 1 || simulated.log.frames[0].blobs.size() != 1) {
    ADD_FAILURE() << "expected one frame with one blob";
    return {};
  }
  return simulated.log.frames[0].blobs[0];
}

}  // namespace fencepost::host
