// Whole evaluations of the bundled recordings.
#include "host/evaluate/evaluate.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "host/evaluate/evaluation_json.hpp"
#include "host/evaluate/evaluation_text.hpp"
#include "host/scene/load.hpp"
#include "tests/host/contents.hpp"
#include "tests/host/evaluate/shapes.hpp"

namespace fencepost::host {
namespace {

const std::string kRecordings = FENCEPOST_SOURCE_DIR "/host/share/recordings/";
constexpr const char* kNames[] = {"approach_stop", "blocks_arc", "corridor", "noisy_arc"};

Scene scene_of(const std::string& name) {
  const LoadedScene scene = load_scene(kRecordings + name + ".json");
  EXPECT_TRUE(scene.ok()) << name;
  return *scene;
}
Evaluation evaluated(const std::string& name, const Scene& scene) {
  const EvaluateOutcome outcome = evaluate(test::bundled_log(name), name, scene, {});
  EXPECT_FALSE(outcome.replay.unreadable);
  return outcome.evaluation;
}

TEST(Evaluate, TheBundledRecordingsAreTheirScenesOwn) {
  for (const char* name : kNames) {
    SCOPED_TRACE(name);
    const Evaluation evaluation = evaluated(name, scene_of(name));
    EXPECT_TRUE(evaluation.frame_truth);
    EXPECT_EQ(evaluation.swaps, 0U);
    EXPECT_TRUE(evaluation.phantoms.empty());
    for (const ObjectEvaluation& object : evaluation.objects) {
      EXPECT_FALSE(object.missed) << object.name;
      ASSERT_TRUE(object.found) << object.name;
      EXPECT_LE(object.found->views, object.visible) << object.name;
      EXPECT_LT(object.cuts.back().position_error.value_or(9), 0.1) << object.name;
    }
  }
}

// The cut at n views is what a replay that stops there finds: not what the end of the run makes of it.
TEST(Evaluate, ACutIsAReplayThatStopsThere) {
  const std::string log = test::bundled_log("noisy_arc");
  const Scene scene = scene_of("noisy_arc");
  const Evaluation evaluation = evaluated("noisy_arc", scene);
  std::size_t compared = 0;
  for (std::uint64_t frames = 1; frames <= 24; ++frames) {
    ReplayOptions options;
    options.frames = frames;
    for (const ObjectResult& object : replay(log, "", options).result.objects) {
      for (const ObjectEvaluation& measured : evaluation.objects) {
        if (!measured.found || measured.found->id != object.id) continue;
        for (const Cut& cut : measured.cuts) {
          if (cut.end || cut.views != object.views) continue;
          for (std::size_t m = 0; m < object.models.size(); ++m) {
            const Score expected = score(object.models[m].geometry, scene.objects[measured.truth].footprint);
            EXPECT_EQ(cut.models.at(m).model, object.models[m].name);
            EXPECT_EQ(cut.models.at(m).score.recklessness, expected.recklessness);
            EXPECT_EQ(cut.models.at(m).score.paranoia, expected.paranoia);
            ++compared;
          }
        }
      }
    }
  }
  EXPECT_GE(compared, 3U * 4U * 4U);  // objects, views 2 to 18, models
}

TEST(Evaluate, AnotherSeedIsNotThisLogsTruth) {
  Scene scene = scene_of("noisy_arc");
  scene.seed += 1;
  const Evaluation evaluation = evaluated("noisy_arc", scene);
  EXPECT_FALSE(evaluation.frame_truth);
  EXPECT_EQ(evaluation.swaps, std::nullopt);
  for (const ObjectEvaluation& object : evaluation.objects) {
    EXPECT_TRUE(object.found);
    EXPECT_EQ(object.swaps, std::nullopt);
    EXPECT_GT(object.visible, 60U) << "its signature was seen";
  }
}

// Truth with one more red box that was never there, and without the yellow one that was.
TEST(Evaluate, CountsMissedAndPhantomObjects) {
  Scene scene = scene_of("blocks_arc");
  scene.path = std::monostate{};
  scene.objects[1] = {"second red box", 1, 0, 0.2, testing::box(5, 5, 0.1, 0.1)};
  const Evaluation evaluation = evaluated("blocks_arc", scene);
  const ObjectEvaluation& absent = evaluation.objects.at(1);
  EXPECT_TRUE(absent.missed);
  EXPECT_FALSE(absent.found);
  ASSERT_EQ(absent.cuts.size(), 6U);  // 2, 4, 8, 18, 75 and the end
  ASSERT_EQ(evaluation.phantoms.size(), 1U);
  EXPECT_EQ(evaluation.phantoms[0].signature, 2);
  EXPECT_EQ(evaluation.phantoms[0].follows, std::nullopt);
}

// 19 frames of a colour are too few to be missed, 20 are not.
TEST(Evaluate, WhatWasHardlyVisibleIsNotMissed) {
  Scene scene = scene_of("blocks_arc");
  scene.path = std::monostate{};
  scene.objects = {{"elsewhere", 1, 0, 0.2, testing::box(5, 5, 0.1, 0.1)}};
  std::istringstream lines(test::bundled_log("blocks_arc"));
  std::string log;
  std::uint64_t frames = 0;
  std::vector<bool> missed;
  for (std::string line; std::getline(lines, line);) {
    log += line + "\n";
    if (line.rfind("$FPFRM", 0) != 0 || ++frames < 19 || frames > 20) continue;
    const Evaluation evaluation = evaluate(log, "", scene, {}).evaluation;
    EXPECT_EQ(evaluation.objects.at(0).visible, frames);
    missed.push_back(evaluation.objects.at(0).missed);
  }
  EXPECT_EQ(missed, (std::vector<bool>{false, true}));
}

TEST(Evaluate, OfSeveralRunsTheLastCounts) {
  const std::string log = test::bundled_log("blocks_arc");
  const Scene scene = scene_of("blocks_arc");
  const Evaluation once = evaluate(log, "", scene, {}).evaluation;
  const Evaluation twice = evaluate(log + log, "", scene, {}).evaluation;
  EXPECT_EQ(twice.frames, once.frames);
  EXPECT_EQ(twice.digest, once.digest);
  EXPECT_EQ(twice.objects.at(0).visible, once.objects.at(0).visible);
}

TEST(Evaluate, AnUnreadableLogIsSaid) {
  EXPECT_TRUE(evaluate("no log\n", "x", scene_of("blocks_arc"), {}).replay.unreadable);
}

TEST(Evaluate, TheSameInputGivesTheSameBytesWithinEightyColumns) {
  std::vector<std::string> json;
  std::vector<std::string> text;
  const std::vector<std::uint32_t> views = EvaluateOptions{}.views;
  for (int time = 0; time < 2; ++time) {
    std::vector<Evaluation> evaluations;
    for (const char* name : kNames) {
      evaluations.push_back(evaluated(name, scene_of(name)));
      const std::vector<Evaluation> one{evaluations.back()};
      text.push_back(evaluation_text(one, summarise(one, views), views));
    }
    const Summary summary = summarise(evaluations, views);
    text.push_back(evaluation_text(evaluations, summary, views));
    json.push_back(to_json(evaluations, summary, views));
  }
  EXPECT_EQ(json[0], json[1]);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(text[i], text[i + 5]);
    std::istringstream lines(text[i]);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80U) << line;
  }
}

}  // namespace
}  // namespace fencepost::host
