#include "firmware/recon/track/schedule.hpp"

#include <gtest/gtest.h>

namespace fencepost::test {
namespace {

using base::milliseconds;
using recon::ModelPace;

constexpr base::Time kStart{50'000'000};

// Frames of one second whose sightings models take.
int taken_at(int frames_per_second) {
  ModelPace pace;
  int taken = 0;
  for (int i = 0; i < frames_per_second; ++i) {
    const base::Time exposure = kStart + base::Duration{base::Time::kPerUnit * i / frames_per_second};
    taken += pace.due(exposure, milliseconds(30)) ? 1 : 0;
  }
  return taken;
}

TEST(ModelPace, TakesAllOfASlowCamerasFramesAndSomeOfAFastOnes) {
  EXPECT_EQ(taken_at(10), 10);
  EXPECT_EQ(taken_at(33), 33);
  EXPECT_EQ(taken_at(50), 25);
  EXPECT_EQ(taken_at(60), 30);
}

TEST(ModelPace, AnIntervalOfNothingTakesAll) {
  ModelPace pace;
  EXPECT_TRUE(pace.due(kStart, {}));
  EXPECT_TRUE(pace.due(kStart, {}));
}

TEST(ModelPace, ANewRunAndAClockThatWentBackBeginAnew) {
  ModelPace pace;
  EXPECT_TRUE(pace.due(kStart, milliseconds(30)));
  EXPECT_FALSE(pace.due(kStart + milliseconds(29), milliseconds(30)));
  EXPECT_TRUE(pace.due(kStart - milliseconds(100), milliseconds(30)));
  pace.clear();
  EXPECT_TRUE(pace.due(kStart - milliseconds(99), milliseconds(30)));
}

// At the interval itself it is due again, and a time that is the same is not.
TEST(ModelPace, IsDueAtTheInterval) {
  ModelPace pace;
  EXPECT_TRUE(pace.due(kStart, milliseconds(30)));
  EXPECT_FALSE(pace.due(kStart, milliseconds(30)));
  EXPECT_TRUE(pace.due(kStart + milliseconds(30), milliseconds(30)));
  EXPECT_FALSE(pace.due(kStart + milliseconds(59), milliseconds(30)));
}

}  // namespace
}  // namespace fencepost::test
