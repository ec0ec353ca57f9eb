// A log that is read in portions, and what is kept of it.
#include <gtest/gtest.h>

#include "host/replay/check.hpp"
#include "host/replay/complaints.hpp"
#include "host/replay/kept_path.hpp"
#include "host/replay/pass_watch.hpp"
#include "host/replay/replay.hpp"
#include "host/result/to_json.hpp"
#include "tests/host/contents.hpp"

namespace fencepost::test {
namespace {

using host::Check;
using host::KeptPath;
using host::LogSource;
using host::PoseResult;
using host::replay;
using host::ReplayOptions;
using host::ReplayOutcome;
using host::to_json;

/// In portions of 1, 2, 3, ... bytes, each in memory of its own.
LogSource growing_portions(const std::string& log) {
  return [&log, at = std::size_t{0}, size = std::size_t{0}, part = std::string()]() mutable {
    part = log.substr(at, ++size);
    at += part.size();
    return std::string_view(part);
  };
}

TEST(Streaming, PortionsChangeNothing) {
  for (const char* name : {"approach_stop", "noisy_arc"}) {
    const std::string log = bundled_log(name);
    ReplayOptions options;
    options.check = true;
    const ReplayOutcome whole = replay(log, name, options);
    const ReplayOutcome parts = replay(growing_portions(log), name, options);
    EXPECT_EQ(to_json(parts.result), to_json(whole.result));
    EXPECT_EQ(parts.check.compared, whole.check.compared);
  }
}

TEST(Streaming, ReadsNoFurtherThanItHasTo) {
  const std::string log = bundled_log("corridor");
  std::size_t asked = 0;
  const LogSource by_line = [&, at = std::size_t{0}]() mutable {
    ++asked;
    const std::size_t from = at;
    at = std::min(log.size(), log.find('\n', at) + 1);
    return std::string_view(log).substr(from, at - from);
  };
  ReplayOptions options;
  options.frames = 3;
  const ReplayOutcome outcome = replay(by_line, "corridor", options);
  EXPECT_EQ(outcome.result.log.frames, 3U);
  EXPECT_EQ(asked, outcome.result.log.records + outcome.result.log.foreign);
}

PoseResult at(double t) { return {t, 2 * t, 0, 0}; }

TEST(KeptPath, KeepsAllWhereThereIsRoomOrNoLimit) {
  KeptPath path(10);
  KeptPath all;
  for (int i = 0; i < 9; ++i) path.add(at(i));
  for (int i = 0; i < 1000; ++i) all.add(at(i));
  EXPECT_EQ(path.to_the_end().size(), 9U);
  EXPECT_EQ(all.to_the_end().size(), 1000U);
  EXPECT_EQ(all.poses().size(), 1000U);
  path.clear();
  EXPECT_TRUE(path.empty());
  EXPECT_TRUE(path.to_the_end().empty());
}

// However long it is: the first, then evenly, then the last.
TEST(KeptPath, OfALongOneItKeepsEveryNth) {
  constexpr std::size_t kMax = 10;
  KeptPath path(kMax);
  std::size_t longest = 0;
  for (int i = 0; i < 5000; ++i) {
    path.add(at(i));
    const std::vector<PoseResult> kept = path.to_the_end();
    longest = std::max(longest, kept.size());
    ASSERT_LE(kept.size(), kMax);
    ASSERT_EQ(kept.front().t, 0);
    ASSERT_EQ(kept.back().t, i);
    if (kept.size() < 3) continue;
    const double step = kept[1].t - kept[0].t;
    for (std::size_t k = 1; k + 1 < kept.size(); ++k) ASSERT_EQ(kept[k].t - kept[k - 1].t, step);
    ASSERT_LE(kept.back().t - kept[kept.size() - 2].t, step);
    ASSERT_TRUE(step <= 1 || kept.size() > kMax / 2) << "no fewer than it has to";
  }
  EXPECT_EQ(longest, kMax);
}

TEST(KeptPath, BoundsTheResultsPath) {
  const std::string log = bundled_log("corridor");
  ReplayOptions options;
  const auto whole = replay(log, "corridor", options).result;
  options.most_poses = 100;
  const auto thinned = replay(log, "corridor", options).result;
  ASSERT_GT(whole.path.size(), 200U);
  EXPECT_LE(thinned.path.size(), 100U);
  EXPECT_GT(thinned.path.size(), 50U);
  EXPECT_EQ(thinned.path.back().t, whole.path.back().t);
  EXPECT_EQ(thinned.digest, whole.digest);
}

TEST(Complaints, AreEachMadeOnceAndNotWithoutEnd) {
  host::Complaints complaints;
  for (int i = 0; i < 1000; ++i) {
    complaints.add("always the same");
    complaints.add("setting " + std::to_string(i));
  }
  EXPECT_EQ(complaints.all().size(), host::Complaints::kMax);
  EXPECT_EQ(complaints.all()[0], "always the same");
  EXPECT_EQ(complaints.all()[1], "setting 0");
}

record::DigestReport digest(std::uint32_t frame, std::uint64_t value) { return {frame, value}; }

TEST(Check, ComparesWhicheverComesFirst) {
  Check check;
  check.own(digest(1, 7));
  check.logged(digest(1, 7), 10);
  check.logged(digest(2, 8), 11);
  check.own(digest(2, 8));
  check.logged(digest(3, 9), 12);
  check.own(digest(3, 10));
  check.logged(digest(4, 9), 13);
  check.settle();
  EXPECT_EQ(check.outcome().compared, 4U);
  EXPECT_EQ(check.outcome().differing, 2U);
  ASSERT_EQ(check.outcome().mismatches.size(), 2U);
  EXPECT_TRUE(check.outcome().mismatches[0].starts_with("line 12: logged $FPDIG,3,")) << check.outcome().mismatches[0];
  EXPECT_NE(check.outcome().mismatches[0].find("this replay: $FPDIG,3,"), std::string::npos);
  EXPECT_NE(check.outcome().mismatches[1].find("nothing of that kind"), std::string::npos);
}

// A record of ours is forgotten after Check::kWindow others, and one that has no partner is settled in time. Neither
// list grows with the log.
TEST(Check, LooksNoFurtherThanItsWindow) {
  Check check;
  const auto count = static_cast<std::uint32_t>(Check::kWindow);
  check.logged(digest(0, 1), 1);
  for (std::uint32_t i = 1; i <= count; ++i) check.own(digest(i, 1));
  EXPECT_EQ(check.outcome().differing, 1U) << "before the end";
  check.logged(digest(1, 1), 2);
  check.own(digest(count + 1, 1));
  check.logged(digest(1, 1), 3);
  check.logged(digest(2, 1), 4);
  check.settle();
  EXPECT_EQ(check.outcome().compared, 4U);
  EXPECT_EQ(check.outcome().differing, 2U) << "the first, and line 3";
}

TEST(PassWatch, ForgetsWhatIsInTheMapNoMore) {
  host::PassWatch watch;
  for (std::uint32_t id = 1; id <= 3; ++id) watch.look(1, id, 0, {1, 0.3}, 0.05);
  watch.forget_lost(3, [](std::uint32_t) { return false; });
  watch.look(2, 1, 0, {-1, 0.3}, 0.05);
  EXPECT_EQ(watch.passes().size(), 1U) << "there is room for as many as the map holds";
  watch.look(2, 4, 0, {1, 0.3}, 0.05);
  watch.look(2, 5, 0, {1, 0.3}, 0.05);
  watch.forget_lost(3, [](std::uint32_t id) { return id != 2; });
  for (std::uint32_t id = 2; id <= 3; ++id) watch.look(3, id, 0, {-1, 0.3}, 0.05);
  ASSERT_EQ(watch.passes().size(), 2U);
  EXPECT_EQ(watch.passes()[1].id, 3U);
}

// A dip of the power at the end: the robot begins anew, and then nothing.
TEST(Runs, WhatFollowsTheLastStepIsInTheOwnLogToo) {
  const std::string log = bundled_log("approach_stop");
  const std::size_t begin = log.find('\n', log.find("$FPCAM")) + 1;
  const std::string dip = log + log.substr(0, begin);
  std::string own;
  ReplayOptions options;
  options.log = [&](std::string_view line) { own += line; };
  const ReplayOutcome first = replay(dip, "dip", options);
  EXPECT_EQ(first.runs, 2U);
  const ReplayOutcome again = replay(own, "own", {});
  EXPECT_EQ(again.runs, 2U);
  EXPECT_EQ(again.result.digest, first.result.digest);
  EXPECT_EQ(again.result.camera, first.result.camera);
}

TEST(Runs, EachCanBeAskedFor) {
  const std::string a = bundled_log("approach_stop");
  const std::string b = bundled_log("corridor");
  ReplayOptions options;
  const auto of = [&](std::uint32_t run) {
    options.run = run;
    return replay(a + b + a, "three", options);
  };
  const auto alone = replay(b, "b", {}).result;
  const ReplayOutcome second = of(2);
  EXPECT_EQ(second.runs, 2U);
  EXPECT_EQ(second.result.digest, alone.digest);
  EXPECT_EQ(second.result.alerts, alone.alerts);
  EXPECT_EQ(second.result.path.size(), alone.path.size());
  EXPECT_EQ(of(1).result.digest, replay(a, "a", {}).result.digest);
  EXPECT_EQ(to_json(of(3).result), to_json(replay(a + b + a, "three", {}).result));
  const ReplayOutcome none = of(4);
  ASSERT_TRUE(none.unreadable);
  EXPECT_NE(none.unreadable->message.find("no run 4 in it, the last is 3"), std::string::npos);
}

}  // namespace
}  // namespace fencepost::test
