// The simulator makes the recordings that come with the project from their scenes, byte for byte.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "host/scene/load.hpp"
#include "tests/host/contents.hpp"
#include "tests/host/simulate/recorded.hpp"

namespace fencepost::host {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = fs::path(FENCEPOST_SOURCE_DIR) / "host/share/recordings";

TEST(Recordings, AreTheSimulatorsBytes) {
  int compared = 0;
  for (const auto& entry : fs::directory_iterator(kFolder)) {
    if (entry.path().extension() != ".json") continue;
    const LoadedScene scene = load_scene(entry.path().string());
    ASSERT_TRUE(scene.ok()) << scene.error().message();
    const Simulated simulated = run(*scene);
    const std::string committed = test::contents(fs::path(entry.path()).replace_extension(".log"));
    if (committed != simulated.log.text) {
      const fs::path fresh = fs::path(testing::TempDir()) / entry.path().stem().concat(".log");
      std::ofstream(fresh, std::ios::binary) << simulated.log.text;
      ADD_FAILURE() << entry.path().stem() << ".log is out of date; the new one is " << fresh;
    }
    EXPECT_LT(committed.size(), 150'000U);
    EXPECT_EQ(simulated.summary.frames_inside, 0U);
    ++compared;
  }
  EXPECT_GE(compared, 4);
}

TEST(Recordings, ApproachEndsTwentyCentimetresFromTheBox) {
  const LoadedScene scene = load_scene((kFolder / "approach_stop.json").string());
  ASSERT_TRUE(scene.ok());
  const Simulated simulated = run(*scene);
  EXPECT_NEAR(scene->objects[0].footprint.outer[0].x - simulated.log.odometry.back().x.to_double(), 0.2, 0.2 * 0.02)
      << "one odometry step at 0.2 m/s";
  EXPECT_FALSE(simulated.log.frames.back().blobs.empty()) << "the box is still in sight";
}

}  // namespace
}  // namespace fencepost::host
