#include "host/replay/log_replay.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "host/result/to_json.hpp"

namespace fencepost::test {
namespace {

using host::LogReplay;
using host::replay;
using host::ReplayOptions;
using host::to_json;

std::string recorded(const std::string& name) {
  std::ifstream file(FENCEPOST_SOURCE_DIR "/host/share/recordings/" + name + ".log", std::ios::binary);
  EXPECT_TRUE(file) << name;
  std::stringstream bytes;
  bytes << file.rdbuf();
  return bytes.str();
}

TEST(LogReplay, LookingOnTheWayChangesNothing) {
  const std::string log = recorded("noisy_arc");
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
  const std::string log = recorded("corridor");
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
  const std::string log = recorded("approach_stop");
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

}  // namespace
}  // namespace fencepost::test
