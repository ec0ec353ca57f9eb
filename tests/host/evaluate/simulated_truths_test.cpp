#include "host/evaluate/simulated_truths.hpp"

#include <gtest/gtest.h>

#include "host/evaluate/evaluate.hpp"
#include "host/scene/load.hpp"
#include "host/simulate/simulate.hpp"

namespace fencepost::host {
namespace {

Scene scene_named(const std::string& name) {
  const LoadedScene scene = load_scene(FENCEPOST_SOURCE_DIR "/host/share/recordings/" + name + ".json");
  EXPECT_TRUE(scene.ok());
  return *scene;
}

std::vector<FrameTruth> frames_of(const Scene& scene) {
  std::vector<FrameTruth> frames;
  const auto done = simulate_with_truth(
      scene, [](std::string_view) {}, [&](const FrameTruth& truth) { frames.push_back(truth); });
  EXPECT_TRUE(done.ok());
  return frames;
}

TEST(SimulatedTruths, KnowsWhatAllFramesInMemoryKnow) {
  const Scene scene = scene_named("noisy_arc");
  const std::vector<FrameTruth> frames = frames_of(scene);
  const FrameTruths all(frames);
  SimulatedTruths truths(scene);
  for (int run = 0; run < 2; ++run) {
    std::size_t known = 0;
    for (const FrameTruth& frame : frames) {
      const recon::WaitingFrame placed = recon::make_waiting(frame.frame, 0);
      const auto owners = truths.owners(placed);
      ASSERT_EQ(owners, all.owners(placed)) << frame.frame.frame;
      known += owners ? 1U : 0U;
    }
    EXPECT_EQ(known, frames.size());
    truths.restart();
  }
}

TEST(SimulatedTruths, MayBeAskedForSomeFramesOnly) {
  const Scene scene = scene_named("corridor");
  const std::vector<FrameTruth> frames = frames_of(scene);
  ASSERT_GT(frames.size(), 150U);
  SimulatedTruths truths(scene);
  for (std::size_t i = 5; i < frames.size(); i += 37) {
    EXPECT_TRUE(truths.owners(recon::make_waiting(frames[i].frame, 0))) << i;
  }
  recon::WaitingFrame none = recon::make_waiting(frames.back().frame, 0);
  none.frame += 1000;
  EXPECT_FALSE(truths.owners(none));
}

TEST(SimulatedTruths, EndsWhereNobodyAsksAnyMore) {
  const Scene scene = scene_named("corridor");
  for (int i = 0; i < 20; ++i) {
    SimulatedTruths truths(scene);
    if (i % 2 == 0) {
      EXPECT_FALSE(truths.owners({}));
    }
  }
  Scene still = scene;
  still.path = std::monostate{};
  EXPECT_FALSE(SimulatedTruths(still).owners({}));
}

TEST(Evaluate, ByPortionsIsTheSame) {
  const Scene scene = scene_named("noisy_arc");
  std::string log;
  ASSERT_TRUE(simulate(scene, [&](std::string_view line) { log += line; }).ok());
  const EvaluateOutcome whole = evaluate(log, "log", scene, {});
  std::size_t at = 0;
  const LogSource source = [&] {
    const std::string_view part = std::string_view(log).substr(at, 1000);
    at += part.size();
    return part;
  };
  const EvaluateOutcome parts = evaluate(source, "log", scene, {});
  EXPECT_TRUE(parts.evaluation.frame_truth);
  EXPECT_EQ(parts.evaluation.digest, whole.evaluation.digest);
  EXPECT_EQ(parts.evaluation.swaps, whole.evaluation.swaps);
  EXPECT_EQ(parts.evaluation.objects.size(), whole.evaluation.objects.size());
  EXPECT_TRUE(parts.replay.result.alerts.empty());
  EXPECT_LE(parts.replay.result.path.size(), 2U);
}

}  // namespace
}  // namespace fencepost::host
