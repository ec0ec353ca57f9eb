#include "host/replay/log_replay.hpp"

#include <gtest/gtest.h>

#include "host/result/to_json.hpp"
#include "tests/host/contents.hpp"

namespace fencepost::test {
namespace {

using host::LogReplay;
using host::replay;
using host::ReplayOptions;
using host::to_json;

TEST(LogReplay, LookingOnTheWayChangesNothing) {
  const std::string log = bundled_log("noisy_arc");
  ReplayOptions options;
  options.check = true;
  LogReplay looked(options);
  std::size_t looks = 0;
  for (std::size_t i = 0; i < log.size(); ++i) {
    looked.push(log[i]);
    if (i % 4001 == 0) looks += to_json(looked.now()).size() > 100 ? 1U : 0U;
  }
  looked.finish();
  EXPECT_GT(looks, 5U);
  EXPECT_EQ(to_json(looked.now()), to_json(replay(log, "log", options).result));
}

TEST(LogReplay, IsOnTheWayWhereALogCutThereEnds) {
  const std::string log = bundled_log("corridor");
  const std::size_t half = log.rfind('\n', log.size() / 2) + 1;
  const ReplayOptions options;
  LogReplay part(options);
  for (const char byte : log.substr(0, half)) part.push(byte);
  const host::ResultDocument now = part.now();
  const host::ResultDocument cut = replay(log.substr(0, half), "log", options).result;
  EXPECT_EQ(now.digest, cut.digest);
  EXPECT_EQ(now.alerts, cut.alerts);
  EXPECT_EQ(now.objects.size(), cut.objects.size());
  EXPECT_EQ(part.time(), cut.pose->t);
  EXPECT_EQ(part.path().size(), now.path.size());
  EXPECT_TRUE(part.now(false).path.empty());
}

TEST(LogReplay, TellsWhatBecameOfEachLine) {
  const ReplayOptions options;
  LogReplay log(options);
  std::vector<record::LineUse> uses;
  for (const char byte : std::string("hello\n$FPODO,1*0000\n$FPO")) {
    if (const auto line = log.push(byte)) uses.push_back(line->use);
  }
  EXPECT_EQ(uses, (std::vector{record::LineUse::kForeign, record::LineUse::kRejected}));
  const auto last = log.finish();
  ASSERT_TRUE(last);
  EXPECT_EQ(last->reject, record::Reject::kTruncated);
  EXPECT_EQ(last->line_number, 3U);
}

TEST(LogReplay, CountsRunsAndBeginsAnew) {
  const std::string log = bundled_log("approach_stop");
  const ReplayOptions options;
  LogReplay twice(options);
  EXPECT_EQ(twice.runs(), 0U);
  EXPECT_EQ(twice.settings(), nullptr);
  for (const char byte : log + log) twice.push(byte);
  EXPECT_EQ(twice.runs(), 2U);
  ASSERT_NE(twice.settings(), nullptr);
  twice.finish();
  EXPECT_EQ(twice.now().digest, replay(log, "log", options).result.digest);
  EXPECT_EQ(twice.now().log.frames, 2 * replay(log, "log", options).result.log.frames);
}

// The robot's records that are compared are missed when they cannot be read; others say nothing.
TEST(LogReplay, CountsDamagedRecordsOfThoseThatAreCompared) {
  ReplayOptions options;
  options.check = true;
  const auto damaged = [&](const std::string& log) {
    LogReplay replayed(options);
    std::string_view left = log;
    while (!left.empty()) replayed.take(left);
    replayed.finish();
    LogReplay by_bytes(options);
    for (const char byte : log) by_bytes.push(byte);
    by_bytes.finish();
    EXPECT_EQ(by_bytes.check().damaged, replayed.check().damaged) << log;
    EXPECT_EQ(by_bytes.check().first_damaged, replayed.check().first_damaged) << log;
    return replayed.check().damaged;
  };
  for (const char* line : {"$FPALR,1*0000", "$FPALV,", "$FPOBJ,x*1234", "$FPCAL,1,2", "$FPDIG,3,00*AAAA",
                           "$FPxLR,1*0000", "$FP", "%FPALR,1*0000", "$XPALR,1*0000", "$FPALR,"}) {
    EXPECT_EQ(damaged(std::string("boot\n") + line + "\n"), 1U) << line;
  }
  for (const char* line : {"$FPODO,1*0000", "$FPFRM,1,2*0000", "hello", "", "$", "FPALR,1,2", ">>>ALR,1", "$GPALR"}) {
    EXPECT_EQ(damaged(std::string(line) + "\n"), 0U) << line;
  }
  EXPECT_EQ(damaged("$FPALR,1"), 0U) << "the recording was cut off";
  LogReplay replayed(options);
  std::string_view log = "boot\n$FPODO,1*0000\n$FPALR,1*0000\n$FPDIG,1*0000\n";
  while (!log.empty()) replayed.take(log);
  EXPECT_EQ(replayed.check().damaged, 2U);
  EXPECT_EQ(replayed.check().first_damaged, 3U);
}

}  // namespace
}  // namespace fencepost::test
