#include <gtest/gtest.h>

#include "host/doctor/log/difference.hpp"
#include "tests/host/cli/run.hpp"
#include "tests/host/recorder/stream.hpp"

namespace fencepost::host {
namespace {

using testing::line_of;

std::string recorded_log(const char* name) {
  return testing::slurp(std::string(FENCEPOST_SOURCE_DIR "/host/share/recordings/") + name);
}

doctor::Difference difference(const std::string& first, const std::string& second) {
  return doctor::difference_of(doctor::survey_log(first, "a.log"), doctor::survey_log(second, "b.log"));
}

/// Behind the header.
std::string with(std::string log, const std::string& fields) {
  log.insert(log.find('\n') + 1, line_of(fields));
  return log;
}

TEST(ReplayDifference, IsNoneOfALogAndItself) {
  const std::string log = recorded_log("approach_stop.log");
  const doctor::Difference none = difference(log, log);
  EXPECT_FALSE(none.any());
  EXPECT_GT(none.alerts_alike, 4U) << "something was compared";
}

TEST(ReplayDifference, ShowsASettingAndTheAlertsThatItMoves) {
  const std::string log = recorded_log("approach_stop.log");
  const doctor::Difference found = difference(log, with(log, "FPCFG,alert.notice,0.8"));
  ASSERT_EQ(found.settings.size(), 1U);
  EXPECT_EQ(found.settings[0].key, "alert.notice");
  EXPECT_EQ(found.settings[0].second, "0.8");
  ASSERT_FALSE(found.alerts.empty());
  for (const auto& alert : found.alerts) {
    const auto& one = alert.first ? *alert.first : *alert.second;
    EXPECT_TRUE(one.level == record::AlertLevel::kNotice || one.level == record::AlertLevel::kClear);
  }
  EXPECT_GT(found.alerts_alike, 1U) << "stop and warn are where they were";
}

TEST(ReplayDifference, ShowsWhatChangedOfTheCalibration) {
  const std::string log = recorded_log("approach_stop.log");
  const std::size_t begin = log.find("$FPCAM") + 1;
  std::string fields = log.substr(begin, log.find('*', begin) - begin);
  const std::string old_line = log.substr(begin - 1, log.find('\n', begin) + 2 - begin);
  fields.replace(fields.find(",0.1200"), 7, ",0.1300");
  std::string other = log;
  for (std::size_t at = 0; (at = other.find(old_line, at)) != std::string::npos; ++at) {
    other.replace(at, old_line.size(), line_of(fields));
  }
  const doctor::Difference found = difference(log, other);
  ASSERT_EQ(found.calibration.size(), 1U);
  EXPECT_EQ(found.calibration[0].key, "mount z");
  EXPECT_EQ(found.calibration[0].first, "0.1200");
  EXPECT_EQ(found.calibration[0].second, "0.1300");
  const std::string text = doctor::difference_text(found, "a.log", "b.log");
  EXPECT_NE(text.find("  mount z                        0.1200           0.1300\n"), std::string::npos) << text;
}

TEST(ReplayDifference, ShowsAlertsThatOnlyOneRunHas) {
  const std::string log = recorded_log("approach_stop.log");
  const std::string half = log.substr(0, log.find('\n', log.size() / 2) + 1);
  const doctor::Difference found = difference(log, half);
  bool only_first = false;
  for (const auto& alert : found.alerts) only_first = only_first || (alert.first && !alert.second);
  EXPECT_TRUE(only_first);
}

}  // namespace
}  // namespace fencepost::host
