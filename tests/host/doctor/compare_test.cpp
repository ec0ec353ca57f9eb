#include <gtest/gtest.h>

#include "host/doctor/log/compare.hpp"
#include "tests/host/doctor/drive.hpp"

namespace fencepost::host {
namespace {

using testing::Drive;

std::vector<std::string> worse(const Drive& today) {
  std::vector<std::string> names;
  for (const auto& item : doctor::what_is_worse(doctor::survey_log(today.stream(), "today.log"),
                                                doctor::survey_log(Drive().stream(), "good.log"))) {
    names.push_back(item.what);
  }
  return names;
}
using Names = std::vector<std::string>;

TEST(DoctorCompare, ADriveIsNotWorseThanItselfNorThanALittleWorseOne) {
  EXPECT_EQ(worse({}), Names{});
  EXPECT_EQ(worse({.frames = 120}), Names{});
  EXPECT_EQ(worse({.seen = [](int i) { return i != 50; }}), Names{});
}

TEST(DoctorCompare, SaysWhatIsWorse) {
  EXPECT_EQ(worse({.frames = 200, .frame_there = [](int i) { return i % 2 == 0; }}),
            (Names{"frames a second", "missing frames, of 1000"}));
  EXPECT_EQ(worse({.seen = [](int i) { return i % 5 != 0; }}), Names{"red: flicker, of 100 frames"});
  EXPECT_EQ(worse({.width = [](int i) { return i % 2 == 0 ? 30 : 34; }}), Names{"red: jitter, px"});
  EXPECT_EQ(worse({.seen = [](int) { return false; }}), Names{"red: seen, % of the frames"});
  EXPECT_EQ(worse({.odometry_x = [](double x) { return x > 0.3 ? x + 1 : x; }}), Names{"jumps of the pose a minute"});
}

TEST(DoctorCompare, BetterIsNotWorse) {
  const doctor::LogSurvey bad = doctor::survey_log(Drive{.seen = [](int i) { return i % 5 != 0; }}.stream(), "bad.log");
  EXPECT_TRUE(doctor::what_is_worse(doctor::survey_log(Drive().stream(), "today.log"), bad).empty());
}

TEST(DoctorCompare, ShowsBothFigures) {
  const auto items =
      doctor::what_is_worse(doctor::survey_log(Drive{.seen = [](int i) { return i % 5 != 0; }}.stream(), "today.log"),
                            doctor::survey_log(Drive().stream(), "good.log"));
  EXPECT_EQ(doctor::worse_text(items, "good.log"),
            "worse than in good.log                    today     then\n"
            "  red: flicker, of 100 frames             24.05        0\n");
}

}  // namespace
}  // namespace fencepost::host
