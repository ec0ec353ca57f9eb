// Watching a replay: every frame is shown, and nothing that is found changes.
#include <gtest/gtest.h>

#include <map>
#include <utility>

#include "host/replay/replay.hpp"
#include "host/result/lookup.hpp"
#include "host/result/to_json.hpp"
#include "tests/host/contents.hpp"

namespace fencepost::test {
namespace {

using host::PlacedFrame;
using host::PlacedSighting;

struct Witness final : host::RunObserver {
  int runs = 0;
  std::uint32_t frames = 0;
  std::map<std::uint32_t, std::uint32_t> views;

  void run_begins() override {
    ++runs;
    frames = 0;
    views.clear();
  }
  void frame_placed(const PlacedFrame& placed) override {
    ++frames;
    for (const PlacedSighting& sighting : placed.sightings) {
      EXPECT_EQ(sighting.views, ++views[sighting.id]) << "each view of an object is shown once";
      ASSERT_LT(sighting.blob, placed.frame.blobs.size());
      const host::ObjectResult object = placed.describe(sighting.id);
      EXPECT_EQ(object.id, sighting.id);
      EXPECT_EQ(object.views, sighting.views);
      EXPECT_EQ(object.signature, placed.frame.blobs[sighting.blob].signature);
    }
  }
};

// How often the hybrid is the cylinder, an outline, or nothing where there is a cylinder.
struct Hybrids final : host::RunObserver {
  int cylinders = 0;
  int outlines = 0;
  int missing = 0;

  void run_begins() override {}
  void frame_placed(const PlacedFrame& placed) override {
    for (const PlacedSighting& sighting : placed.sightings) {
      const host::ObjectResult object = placed.outline(sighting.id);
      const host::MultiPolygon& cylinder = host::find_model(object, "cylinder")->geometry;
      const host::MultiPolygon& hybrid = host::find_model(object, "hybrid")->geometry;
      if (cylinder.empty()) continue;
      if (hybrid.empty()) {
        ++missing;
      } else {
        ++(hybrid.front().outer == cylinder.front().outer ? cylinders : outlines);
      }
    }
  }
};

Hybrids hybrids_of(const std::string& log, const char* profile) {
  Hybrids hybrids;
  host::ReplayOptions options;
  options.profile = profile;
  options.observer = &hybrids;
  EXPECT_FALSE(host::replay(log, "log", options).unreadable);
  return hybrids;
}

TEST(Observer, SeesTheCylinderWhereABoardsOutlineIsBehind) {
  const std::string log = bundled_log("blocks_arc");
  for (const char* board : {"micro", "small"}) {
    SCOPED_TRACE(board);
    const Hybrids hybrids = hybrids_of(log, board);
    EXPECT_GT(hybrids.cylinders, 10);
    EXPECT_EQ(hybrids.missing, 0);
  }
  EXPECT_GT(hybrids_of(log, "small").outlines, 10) << "known well in time";
  const Hybrids desk = hybrids_of(log, "full");
  EXPECT_EQ(desk.cylinders, 0) << "fitted in the same frame";
  EXPECT_GT(desk.outlines, 10);
}

TEST(Observer, SeesEveryFrameAndChangesNothing) {
  using Case = std::pair<const char*, const char*>;
  for (const auto& [name, profile] : {Case{"approach_stop", "micro"}, Case{"blocks_arc", "small"},
                                      Case{"corridor", "full"}, Case{"noisy_arc", "micro"}}) {
    SCOPED_TRACE(std::string(name) + " " + profile);
    const std::string bytes = bundled_log(name);
    std::string plain_log;
    std::string watched_log;
    Witness witness;
    host::ReplayOptions plain;
    plain.profile = profile;
    host::ReplayOptions watched = plain;
    plain.log = [&](std::string_view line) { plain_log += line; };
    watched.log = [&](std::string_view line) { watched_log += line; };
    watched.observer = &witness;
    const auto expected = host::replay(bytes, name, plain);
    const auto found = host::replay(bytes, name, watched);
    EXPECT_EQ(host::to_json(found.result), host::to_json(expected.result));
    EXPECT_EQ(watched_log, plain_log);
    const auto& refused = found.result.log.refused;
    EXPECT_EQ(witness.frames + refused.no_pose + refused.odometry_gap + refused.no_camera + refused.queue,
              found.result.log.frames);
    EXPECT_GT(witness.frames, 0U);
    EXPECT_FALSE(witness.views.empty());
    for (const host::ObjectResult& object : found.result.objects) EXPECT_EQ(object.views, witness.views[object.id]);
  }
}

TEST(Observer, IsToldWhereARunBegins) {
  const std::string bytes = bundled_log("corridor");
  Witness once;
  Witness twice;
  host::ReplayOptions options;
  options.observer = &once;
  static_cast<void>(host::replay(bytes, "once", options));
  options.observer = &twice;
  static_cast<void>(host::replay(bytes + bytes, "twice", options));
  EXPECT_EQ(once.runs, 1);
  EXPECT_EQ(twice.runs, 2);
  EXPECT_EQ(twice.frames, once.frames);
  EXPECT_EQ(twice.views, once.views);
}

}  // namespace
}  // namespace fencepost::test
