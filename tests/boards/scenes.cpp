#include "tests/boards/scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string_view>

#include "host/replay/replay.hpp"
#include "host/result/lookup.hpp"
#include "tests/boards/bench.hpp"
#include "tests/firmware/loop/desk.hpp"
#include "tests/text.hpp"

namespace fencepost::test {
namespace {

host::Point centre_of(const host::Polygon& footprint) {
  host::Point sum{0, 0};
  const auto& ring = footprint.outer;
  for (const host::Point& p : ring) sum = {sum.x + p.x, sum.y + p.y};
  const auto n = static_cast<double>(ring.size());
  return {sum.x / n, sum.y / n};
}

// Of the cylinder's centre, which is a box's middle but for a centimetre or two.
double distance_to_nearest(const host::Scene& scene, const host::ObjectResult& object) {
  double nearest = 1e9;
  for (const host::ModelResult& model : object.models) {
    if (model.name != "cylinder" || !model.circle) continue;
    for (const host::SceneObject& truth : scene.objects) {
      const host::Point centre = centre_of(truth.footprint);
      if (truth.signature != object.signature) continue;
      nearest = std::min(nearest, std::hypot(model.circle->center.x - centre.x, model.circle->center.y - centre.y));
    }
  }
  return nearest;
}

void expect_same_alerts(const std::string& log, const host::ResultDocument& result) {
  EXPECT_EQ(count(log, "$FPALR,"), result.alerts.size());
  for (const record::AlertReport& alert : result.alerts) EXPECT_NE(log.find(line_of(alert)), std::string::npos);
}

void expect_objects(const host::Scene& scene, const host::ResultDocument& result, std::size_t expected, double placed) {
  std::size_t confirmed = 0;
  for (const host::ObjectResult& object : result.objects) {
    if (object.state == record::ObjectState::kTentative) continue;
    ++confirmed;
    EXPECT_LT(distance_to_nearest(scene, object), placed) << "object " << object.id;
  }
  EXPECT_EQ(confirmed, expected);
}

std::size_t confirmed_in(const std::string& log, const std::string& profile) {
  host::ReplayOptions options;
  options.profile = profile;
  std::size_t n = 0;
  for (const auto& object : host::replay(log, "scene", options).result.objects) {
    n += object.state != record::ObjectState::kTentative ? 1 : 0;
  }
  return n;
}

// A wheel base and some cameras never rest: input that came after the digest was reported is not in it.
std::string log_until_digest(const std::string& said) {
  const std::size_t begin = said.find("$FPHDR");
  const std::size_t line = said.rfind('\n', said.rfind("; digest "));
  return said.substr(begin, line + 1 - begin);
}

}  // namespace

void expect_scene_replays(const BoardUnderTest& board, const std::string& profile, const host::Scene& scene,
                          double placed, PoseCorrected corrected) {
  SceneStream stream = stream_of(scene);
  if (corrected == PoseCorrected::kYes) stream.log = with_setting(stream.log, {"correct.pose", "on"});
  Bench bench(board);
  ASSERT_TRUE(bench.await("READY\r\n")) << bench.said();
  ASSERT_TRUE(bench.await_camera(20)) << bench.said();
  ASSERT_TRUE(bench.correct_pose(corrected == PoseCorrected::kYes)) << bench.said();
  ASSERT_TRUE(bench.start_log(stream)) << bench.said();
  bench.play(stream);
  const std::string digest = bench.digest();
  const std::string log = log_until_digest(bench.said());

  host::ReplayOptions options;
  options.check = true;
  const host::ReplayOutcome replayed = host::replay(log, "console", options);
  ASSERT_FALSE(replayed.unreadable) << replayed.unreadable->message;
  const host::ResultDocument& result = replayed.result;
  EXPECT_EQ(result.profile, profile);
  EXPECT_EQ(host::digest_text(result.digest), digest);
  EXPECT_GT(replayed.check.compared, static_cast<std::uint64_t>(20 * board.frames_share));
  EXPECT_EQ(replayed.check.differing, 0U) << (replayed.check.mismatches.empty() ? "" : replayed.check.mismatches[0]);
  for (const auto& rejected : result.log.rejected) EXPECT_EQ(rejected.count, 0U);
  expect_same_alerts(log, result);
  expect_objects(scene, result, confirmed_in(stream.log, profile), placed);
  const auto frames = count(stream.log, "$FPFRM,");
  EXPECT_GT(static_cast<double>(result.log.frames), static_cast<double>(frames) * board.frames_share)
      << "of " << frames;
  EXPECT_EQ(count(bench.said(), "READY"), 0U) << "it was reset";
}

}  // namespace fencepost::test
