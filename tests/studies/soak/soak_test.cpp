// Ten minutes in each profile, and the edge of the stream's time.
#include <gtest/gtest.h>

#include "tests/studies/soak/soak_desk.hpp"
#include "tests/studies/soak/soak_run.hpp"

namespace fencepost::test {
namespace {

void expect_same(const LapQuality& a, const LapQuality& b) {
  EXPECT_EQ(a.found, b.found);
  // A place is a whole number of 10 um wherever it is: 100 m away nothing is rounded differently, but by the judge.
  EXPECT_NEAR(a.center_error, b.center_error, 1e-9);
  EXPECT_NEAR(a.recklessness, b.recklessness, 1e-9);
  EXPECT_NEAR(a.paranoia, b.paranoia, 1e-9);
}

class Soak : public testing::TestWithParam<const char*> {};

TEST_P(Soak, TenMinutesChangeNothing) {
  const SoakFigures figures = run_soak(GetParam(), 18, 1);
  for (const std::string& fault : figures.faults) ADD_FAILURE() << fault;
  EXPECT_GT(figures.minutes, 10);
  EXPECT_TRUE(figures.frame_counter_wrapped);
  EXPECT_TRUE(figures.clock_word_wrapped);
  EXPECT_GT(figures.commands, 100U);
  EXPECT_GT(figures.frames_refused, 0U);  // the slow links were slow
  EXPECT_GT(figures.frames_used, figures.frames_offered * 8 / 10);
  EXPECT_GE(figures.runs_replayed, 15U);
  EXPECT_GT(figures.digests_compared, 1000U);
  EXPECT_EQ(figures.at_start.found, 3U);
  EXPECT_LT(figures.at_start.center_error, 0.01);
  expect_same(figures.far_away, figures.at_start);
  expect_same(figures.at_end, figures.at_start);
  std::printf("  %s: %.1f min, %u of %u blocks in the map after two changes without a reset\n", GetParam(),
              figures.minutes, figures.present_found, figures.present);
}

INSTANTIATE_TEST_SUITE_P(Profiles, Soak, testing::Values("micro", "small", "full"));

// The stream's time ends at 999,999 s, after eleven days. No record can say more, so mode log refuses later inputs.
TEST(SoakEdge, AtTheEndOfTheStreamsTimeALogRefusesAndTheRobotGoesOn) {
  const Piece lap = make_lap(1, {0, 0});
  SoakDesk<config::Micro> desk(base::Time{999'999LL * base::Time::kPerUnit - 4 * base::Time::kPerUnit}, 0);
  desk.set_up(lap.scene);
  desk.drive(lap);
  desk.drain();
  const console::Counters& counters = desk.memory().counters;
  const std::uint32_t used = counters.frames;
  EXPECT_GT(used, 35U);
  EXPECT_LT(used, 42U);  // ten a second for four seconds
  EXPECT_TRUE(desk.frames_add_up(0));
  desk.obey("mode text\n");
  desk.drive(lap);
  EXPECT_GT(counters.frames, used + 70);
  EXPECT_TRUE(desk.frames_add_up(0));
}

}  // namespace
}  // namespace fencepost::test
