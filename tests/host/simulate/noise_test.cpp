// Every noise key against its meaning. Seeds are fixed; bounds are at five sigma or more of the statistic.
#include <gtest/gtest.h>

#include <cmath>

#include "host/simulate/random.hpp"
#include "tests/host/simulate/recorded.hpp"

namespace fencepost::host {
namespace {

/// A box in the middle of the image, columns 103..212, rows 71..147, seen 2000 times by a standing robot.
Scene stare(int frames = 2000) {
  Scene scene = empty_scene();
  scene.path = standing(0, 0, 0, frames);
  scene.objects = {box_object(1, 1.0, -0.2, 1.2, 0.2, 0.2)};
  return scene;
}
constexpr int kLeft = 103;   // 157.5 - 54.72 = 102.78
constexpr int kRight = 212;  // 157.5 + 54.72 = 212.22
constexpr int kWidth = 110;

struct Moments {
  double count = 0;
  double sum = 0;
  double squares = 0;
  void add(double x) { count += 1, sum += x, squares += x * x; }
  [[nodiscard]] double mean() const { return sum / count; }
  [[nodiscard]] double sigma() const { return std::sqrt(squares / count - mean() * mean()); }
};

TEST(Random, IsWellSpreadAndStreamsDiffer) {
  Random random(1, Purpose::kDetection, 0);
  Moments uniform;
  Moments gaussian;
  Moments poisson;
  for (int i = 0; i < 100'000; ++i) {
    uniform.add(random.uniform());
    gaussian.add(random.gaussian());
    poisson.add(random.poisson(0.7));
  }
  EXPECT_NEAR(uniform.mean(), 0.5, 0.005);
  EXPECT_NEAR(uniform.sigma(), std::sqrt(1.0 / 12), 0.005);
  EXPECT_NEAR(gaussian.mean(), 0, 0.016);
  EXPECT_NEAR(gaussian.sigma(), 1, 0.012);
  EXPECT_NEAR(poisson.mean(), 0.7, 0.014);
  EXPECT_NEAR(poisson.sigma(), std::sqrt(0.7), 0.014);
  // Streams of different purposes and indices differ.
  EXPECT_NE(Random(1, Purpose::kDetection, 0).next(), Random(1, Purpose::kDetection, 1).next());
  EXPECT_NE(Random(1, Purpose::kDetection, 0).next(), Random(1, Purpose::kDrift, 0).next());
  EXPECT_NE(Random(1, Purpose::kDetection, 0).next(), Random(2, Purpose::kDetection, 0).next());
}

TEST(Noise, NoneMeansIdenticalFrames) {
  const Simulated simulated = run(stare(50));
  for (const auto& frame : simulated.log.frames) {
    ASSERT_EQ(frame.blobs.size(), 1U);
    EXPECT_EQ(frame.blobs[0].x1, kLeft);
    EXPECT_EQ(frame.blobs[0].x2, kRight);
  }
}

TEST(Noise, EdgeJitterHasItsSigmaOnAllFourEdges) {
  Scene scene = stare();
  scene.noise.edge_px = 2;
  Moments left;
  Moments right;
  Moments top;
  Moments product;
  for (const auto& frame : run(scene).log.frames) {
    ASSERT_EQ(frame.blobs.size(), 1U);
    left.add(frame.blobs[0].x1 - kLeft);
    right.add(frame.blobs[0].x2 - kRight);
    top.add(frame.blobs[0].y1);
    product.add((frame.blobs[0].x1 - kLeft) * (frame.blobs[0].x2 - kRight));
  }
  const double expected = std::sqrt(4 + 1.0 / 12);  // whole pixels add a twelfth
  EXPECT_NEAR(left.mean(), 0, 0.23);
  EXPECT_NEAR(right.mean(), 0, 0.23);
  EXPECT_NEAR(left.sigma(), expected, 0.17);
  EXPECT_NEAR(right.sigma(), expected, 0.17);
  EXPECT_NEAR(top.sigma(), expected, 0.17);
  EXPECT_NEAR(product.mean(), 0, 0.5) << "the edges are independent";
}

TEST(Noise, EdgeBiasMovesAllFourEdgesOutAndKeepsTheDraws) {
  Scene scene = stare(50);
  scene.noise.edge_px = 2;
  const Simulated plain = run(scene);
  scene.noise.edge_bias_px = 3;
  const Simulated padded = run(scene);
  scene.noise.edge_bias_px = -2;
  const Simulated shrunk = run(scene);
  ASSERT_EQ(padded.log.frames.size(), plain.log.frames.size());
  for (std::size_t i = 0; i < plain.log.frames.size(); ++i) {
    ASSERT_EQ(padded.log.frames[i].blobs.size(), 1U);
    const auto& a = plain.log.frames[i].blobs[0];
    for (const auto& [other, out] : {std::pair(&padded, 3), std::pair(&shrunk, -2)}) {
      const auto& b = other->log.frames[i].blobs[0];
      EXPECT_EQ(b.x1, a.x1 - out);
      EXPECT_EQ(b.x2, a.x2 + out);
      EXPECT_EQ(b.y1, a.y1 - out);
      EXPECT_EQ(b.y2, a.y2 + out);
    }
  }
}

TEST(Noise, EdgeBiasMayBeOfOneColour) {
  Scene scene = stare(20);
  const Simulated plain = run(scene);
  scene.noise.edge_bias_px = 3;
  scene.noise.edge_bias_of = {{1, 5}, {2, 7}};
  const Simulated padded = run(scene);
  ASSERT_EQ(padded.log.frames.size(), plain.log.frames.size());
  for (std::size_t i = 0; i < plain.log.frames.size(); ++i) {
    EXPECT_EQ(padded.log.frames[i].blobs[0].x1, plain.log.frames[i].blobs[0].x1 - 5);
  }
}

// The pad is configured on the robot: the camera's boxes do not change by it.
TEST(Noise, APadIsWrittenAndLeavesTheBoxes) {
  Scene scene = stare(20);
  const Simulated plain = run(scene);
  scene.signatures[0].pad = 4;
  const Simulated told = run(scene);
  EXPECT_EQ(told.log.signatures.at(0).pad, 4);
  EXPECT_EQ(told.log.frames, plain.log.frames);
}

TEST(Noise, JitterLeavesBorderEndsOnTheBorder) {
  Scene scene = stare(300);
  scene.objects = {box_object(1, 1.0, 0.2, 1.2, 1.0, 0.2)};
  scene.noise.edge_px = 3;
  scene.noise.edge_bias_px = -8;
  for (const auto& frame : run(scene).log.frames) EXPECT_EQ(frame.blobs[0].x1, 0);
}

TEST(Noise, LossTakesItsShareAndSplitsItsShare) {
  Scene scene = stare();
  scene.noise.loss_probability = 0.4;
  scene.noise.loss_min = 0.2;
  scene.noise.loss_max = 0.4;
  scene.noise.split_share = 0.25;
  int whole = 0;
  int split = 0;
  int left = 0;
  int right = 0;
  Moments share;
  for (const FrameTruth& truth : run(scene).truth) {
    const auto& blobs = truth.frame.blobs;
    if (blobs.size() == 2) {
      ++split;
      const int gap = kWidth - (blobs[0].x2 - blobs[0].x1 + 1) - (blobs[1].x2 - blobs[1].x1 + 1);
      EXPECT_GE(gap, 0.2 * kWidth - 2);
      EXPECT_LE(gap, 0.4 * kWidth + 2);
      continue;
    }
    ASSERT_EQ(blobs.size(), 1U);
    if (truth.blobs[0].left == BlobEnd::kLost) ++left;
    if (truth.blobs[0].right == BlobEnd::kLost) ++right;
    const int width = blobs[0].x2 - blobs[0].x1 + 1;
    if (width == kWidth) {
      ++whole;
    } else {
      share.add(1 - static_cast<double>(width) / kWidth);
    }
  }
  EXPECT_NEAR(whole, 1200, 110);  // 2000 * 0.6, sigma 22
  EXPECT_NEAR(split, 200, 70);    // 2000 * 0.4 * 0.25, sigma 13
  EXPECT_NEAR(left, 300, 80);     // the rest from either side
  EXPECT_NEAR(right, 300, 80);
  EXPECT_NEAR(share.mean(), 0.3, 0.02);  // uniform 0.2..0.4
  EXPECT_NEAR(share.sigma(), 0.2 / std::sqrt(12.0), 0.012);
}

TEST(Noise, GrowthAddsUpToItsMaximum) {
  Scene scene = stare();
  scene.noise.growth_probability = 0.5;
  scene.noise.growth_max = 0.3;
  int grown = 0;
  int left = 0;
  Moments share;
  for (const FrameTruth& truth : run(scene).truth) {
    const auto& blob = truth.frame.blobs[0];
    if (truth.blobs[0].left == BlobEnd::kEdge && truth.blobs[0].right == BlobEnd::kEdge) {
      EXPECT_EQ(blob.x2 - blob.x1 + 1, kWidth);
      continue;
    }
    ++grown;
    if (truth.blobs[0].left == BlobEnd::kGrown) ++left;
    share.add(static_cast<double>(blob.x2 - blob.x1 + 1) / kWidth - 1);
    EXPECT_LE(blob.x2 - blob.x1 + 1, 1.3 * kWidth + 1);
  }
  EXPECT_NEAR(grown, 1000, 112);
  EXPECT_NEAR(left, 500, 100);
  EXPECT_NEAR(share.mean(), 0.15, 0.015);
}

TEST(Noise, MissSwapDropAndFalseBlobsHaveTheirRates) {
  Scene scene = stare();
  scene.noise.miss_probability = 0.2;
  EXPECT_NEAR(static_cast<double>(run(scene).summary.blobs), 1600, 90);
  scene = stare();
  scene.noise.frame_drop_probability = 0.1;
  const Simulated dropped = run(scene);
  EXPECT_NEAR(static_cast<double>(dropped.summary.frames_dropped), 200, 70);
  EXPECT_EQ(dropped.summary.frames + dropped.summary.frames_dropped, 2000U);
  EXPECT_EQ(dropped.log.frames.back().frame, 1999U) << "the camera's count goes on over lost frames";
  scene = stare();
  scene.noise.signature_swap_probability = 0.3;
  int swapped = 0;
  int second = 0;
  for (const auto& frame : run(scene).log.frames) {
    swapped += frame.blobs[0].signature != 1 ? 1 : 0;
    second += frame.blobs[0].signature == 2 ? 1 : 0;
    EXPECT_EQ(frame.blobs[0].rgb, scene.signatures[0].rgb) << "the colour is the object's own";
  }
  EXPECT_NEAR(swapped, 600, 103);
  EXPECT_NEAR(second, 300, 80);
  scene = stare();
  scene.noise.false_rate = 0.5;
  int false_blobs = 0;
  for (const FrameTruth& truth : run(scene).truth) {
    for (std::size_t i = 0; i < truth.blobs.size(); ++i) {
      if (truth.blobs[i].object) continue;
      ++false_blobs;
      const auto& blob = truth.frame.blobs[i];
      EXPECT_EQ(blob.pixels, static_cast<unsigned>((blob.x2 - blob.x1 + 1) * (blob.y2 - blob.y1 + 1)));
    }
  }
  EXPECT_NEAR(false_blobs, 1000, 160);
}

TEST(Noise, LatencyJitterMovesArrivalsNotExposures) {
  Scene scene = stare();
  scene.rate = 20;
  scene.path = standing(0, 0, 0, 2000, 20);
  scene.camera.latency = base::Duration::nearest(0.05);
  scene.noise.latency_jitter = 0.004;
  Moments late;
  for (const FrameTruth& truth : run(scene).truth) late.add((truth.frame.t - truth.exposure).to_double() - 0.05);
  EXPECT_NEAR(late.mean(), 0, 0.0005);
  EXPECT_NEAR(late.sigma(), 0.004, 0.0004);
  scene.camera.latency = base::Duration{0};
  for (const FrameTruth& truth : run(scene).truth) EXPECT_GE(truth.frame.t, truth.exposure);
}

TEST(Noise, YawErrorTurnsTheCameraAgainstItsCalibration) {
  Scene scene = stare(1);
  scene.noise.yaw_error = 0.02;  // to the left: the box moves right by 273.6 * tan(0.02) = 5.5 px
  const auto blob = only_blob(scene);
  EXPECT_NEAR(blob.x1, kLeft + 5.5, 1.5);
  EXPECT_NEAR(blob.x2, kRight + 5.5, 1.5);
}

TEST(Noise, PitchErrorMovesTheRows) {
  const int level = only_blob(stare(1)).y2;
  Scene scene = stare(1);
  scene.noise.pitch_error = 0.02;  // looks down: everything moves up
  EXPECT_NEAR(only_blob(scene).y2, level - 5.5, 1.5);
}

TEST(Noise, OneKeyLeavesTheOthersDrawsAlone) {
  Scene scene = stare(200);
  scene.noise.edge_px = 2;
  const Simulated before = run(scene);
  scene.noise.frame_drop_probability = 0.3;
  scene.noise.drift_walk = 0.1;
  const Simulated after = run(scene);
  ASSERT_LT(after.log.frames.size(), before.log.frames.size());
  for (const auto& frame : after.log.frames) EXPECT_EQ(frame.blobs, before.log.frames[frame.frame].blobs);
}

}  // namespace
}  // namespace fencepost::host
