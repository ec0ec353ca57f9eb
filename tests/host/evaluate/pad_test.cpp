// A camera that pads its boxes makes things too large, and a configured pad mends it.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "host/evaluate/evaluate.hpp"
#include "host/scene/load.hpp"
#include "host/simulate/simulate.hpp"

namespace fencepost::host {
namespace {

/// Means over the objects of a few seeds of a scene at medium noise.
struct Errors {
  double outline = 0;   ///< recklessness and paranoia of the hybrid together
  double position = 0;  ///< m, of the cylinder's centre
  bool own_truth = true;
};

/// The colours' boxes are `padded` px too wide, and the robot is configured for `configured` px.
Errors errors_of(double padded, std::int8_t configured) {
  const LoadedScene loaded = load_scene(FENCEPOST_SOURCE_DIR "/host/share/recordings/noisy_arc.json");
  EXPECT_TRUE(loaded.ok());
  Scene scene = *loaded;
  for (SceneSignature& signature : scene.signatures) {
    signature.pad = configured;
    scene.noise.edge_bias_of[signature.id] = padded;
  }
  Errors errors;
  double objects = 0;
  for (scene.seed = 61; scene.seed < 65; ++scene.seed) {
    std::string log;
    EXPECT_TRUE(simulate(scene, [&](std::string_view line) { log += line; }).ok());
    const EvaluateOutcome outcome = evaluate(log, "padded", scene, {});
    errors.own_truth = errors.own_truth && outcome.evaluation.frame_truth;
    for (const ObjectEvaluation& object : outcome.evaluation.objects) {
      if (!object.found || object.cuts.empty()) {
        ADD_FAILURE() << object.name << " is not in the map";
        continue;
      }
      const Cut& end = object.cuts.back();
      const auto hybrid = std::ranges::find(end.models, "hybrid", &ModelScore::model);
      errors.outline += hybrid->score.recklessness + hybrid->score.paranoia;
      errors.position += end.position_error.value_or(1);
      ++objects;
    }
  }
  errors.outline /= objects;
  errors.position /= objects;
  return errors;
}

TEST(ConfiguredPad, BringsTheMapBackToThatOfBareBoxes) {
  const Errors plain = errors_of(0, 0);
  const Errors padded = errors_of(4, 0);
  const Errors configured = errors_of(4, 4);
  RecordProperty("plain", std::to_string(plain.outline));
  RecordProperty("padded", std::to_string(padded.outline));
  RecordProperty("configured", std::to_string(configured.outline));
  EXPECT_GT(padded.outline, 1.5 * plain.outline);
  EXPECT_LT(configured.outline, 1.1 * plain.outline);
  EXPECT_LT(configured.position, 1.1 * plain.position);
  EXPECT_TRUE(plain.own_truth && padded.own_truth && configured.own_truth);
}

}  // namespace
}  // namespace fencepost::host
