// `fencepost evaluate` as its users run it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/host/cli/run.hpp"

namespace fencepost::host {
namespace {

using nlohmann::json;
using namespace testing;

const std::string kLog = recording("noisy_arc.log");
const std::string kScene = recording("noisy_arc.json");

TEST(EvaluateCommand, FindsTheSceneBesideTheLog) {
  const Outcome run = shell("fencepost evaluate " + kLog);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(holds(run.out, "red box: object 1, confirmed"));
  EXPECT_TRUE(holds(run.out, "3 true objects: 3 found, 0 missed; 0 phantoms; 0 identity swaps\n"));
  EXPECT_EQ(shell("fencepost evaluate " + kLog + " --scene " + kScene).out, run.out);
  EXPECT_EQ(shell("fencepost evaluate - --scene " + kScene + " <" + kLog).out, run.out);
}

TEST(EvaluateCommand, JsonIsTheSameEachTime) {
  const std::string line = "fencepost evaluate --views 8,2,8 --json " + kLog + " " + recording("blocks_arc.log");
  const Outcome run = shell(line + " -o first.json; " + line);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(slurp("first.json"), run.out);
  const json document = json::parse(run.out);
  EXPECT_EQ(document["views"], json({2, 8}));
  EXPECT_EQ(document["logs"].size(), 2U);
  EXPECT_EQ(document["summary"]["objects"], 6);
  EXPECT_EQ(document["summary"]["swaps"], 0);
}

TEST(EvaluateCommand, PairsScenesWithLogsInOrder) {
  const std::string two = "fencepost evaluate --json " + kLog + " --scene " + kScene + " " + recording("corridor.log") +
                          " --scene " + recording("corridor.json");
  const Outcome run = shell(two);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json document = json::parse(run.out);
  EXPECT_EQ(document["logs"][0]["objects"].size(), 3U);
  EXPECT_EQ(document["logs"][1]["objects"].size(), 6U);
  EXPECT_EQ(document["summary"]["missed"], 0);
  EXPECT_EQ(shell(two + " " + recording("blocks_arc.log")).exit_code, 2) << "a log without a scene";
}

TEST(EvaluateCommand, OfSeveralLogsAMessageNamesItsOwn) {
  const std::string damaged =
      "sed '20s/,/;/' " + kLog + " >damaged.log; fencepost evaluate damaged.log --scene " + kScene;
  EXPECT_TRUE(shell(damaged).err.starts_with("1 line rejected: crc, first in line 20"));
  EXPECT_TRUE(ends(shell(damaged + " " + kLog + " --scene " + kScene), 0,
                   "damaged.log: 1 line rejected: crc, first in line 20"));
}

TEST(EvaluateCommand, ABoundThatIsExceededFails) {
  const std::string only = "fencepost evaluate " + kLog + " --model cylinder ";
  const json document = json::parse(shell(only + "--json").out);
  const json& end = document["summary"]["models"].back();
  EXPECT_EQ(end["model"], "cylinder");
  EXPECT_EQ(end["views"], nullptr);
  const double recklessness = end["recklessness"]["mean"];
  const double paranoia = end["paranoia"]["mean"];
  ASSERT_GT(recklessness, 0.001);
  ASSERT_LT(paranoia, 0.9);
  const auto bounds = [](double r, double p) {
    return "--max-recklessness " + std::to_string(r) + " --max-paranoia " + std::to_string(p);
  };
  EXPECT_EQ(shell(only + bounds(recklessness + 0.001, paranoia + 0.001)).exit_code, 0);
  const Outcome reckless = shell(only + bounds(recklessness - 0.001, paranoia + 0.001));
  EXPECT_EQ(reckless.exit_code, 1);
  EXPECT_TRUE(holds(reckless.err, "bound exceeded: recklessness of cylinder"));
  EXPECT_NE(reckless.out, "") << "the measures are still printed";
  EXPECT_EQ(shell(only + bounds(recklessness + 0.001, paranoia - 0.001)).exit_code, 1);
}

TEST(EvaluateCommand, ABoundOnNothingFails) {
  // Truth far away and of a colour that was never seen: nothing found, nothing missed.
  ASSERT_EQ(shell("printf '%s' '{\"format\": 1, \"seed\": 1, \"camera\": {\"width\": 316, \"height\": 208, "
                  "\"fx\": 273.6, \"fy\": 273.6, \"cx\": 157.5, \"cy\": 103.5}, \"signatures\": [{\"id\": 9, "
                  "\"name\": \"grey\", \"rgb\": \"808080\"}], \"objects\": [{\"name\": \"far\", \"signature\": "
                  "9, \"height\": 0.1, \"footprint\": {\"circle\": [9, 9, 0.1]}}]}' >far.json")
                .exit_code,
            0);
  const Outcome run = shell("fencepost evaluate " + kLog + " --scene far.json --max-recklessness 1");
  EXPECT_EQ(run.exit_code, 1) << run.err;
  EXPECT_TRUE(holds(run.err, "no object was measured"));
  EXPECT_TRUE(holds(run.out, "far: not found, visible in 0 frames"));
}

/// All bundled recordings that have a scene.
std::vector<std::string> corpus() {
  return {"approach_stop", "blocks_arc",  "corridor",   "noisy_arc",
          "stop_cmucam2",  "stop_nxtcam", "stop_pixy2", "wro_lap"};
}

std::string logs_of(const std::vector<std::string>& names) {
  std::string words;
  for (const std::string& name : names) words += " " + recording(name + ".log");
  return words;
}

TEST(EvaluateCommand, TheNumberOfJobsChangesNothing) {
  const std::string all = "fencepost evaluate --json" + logs_of(corpus());
  const Outcome one = shell(all + " --jobs 1");
  ASSERT_EQ(one.exit_code, 0) << one.err;
  for (const char* jobs : {"2", "7", "100"}) {
    const Outcome several = shell(all + " --jobs " + jobs);
    EXPECT_EQ(several.out, one.out) << jobs;
    EXPECT_EQ(several.err, one.err) << jobs;
  }
  EXPECT_EQ(shell(all).out, one.out);
}

TEST(EvaluateCommand, MergedPartsAreTheWholeToTheLastByte) {
  const std::vector<std::string> names = corpus();
  const std::string views = " --views 2,18";
  for (const std::size_t cut : {std::size_t{1}, names.size() / 2, names.size() - 1}) {
    const auto middle = names.begin() + static_cast<std::ptrdiff_t>(cut);
    const Outcome parts = shell("fencepost evaluate --part -o a.part" + views + logs_of({names.begin(), middle}) +
                                " && fencepost evaluate --part" + views + logs_of({middle, names.end()}) + " >b.part");
    ASSERT_EQ(parts.exit_code, 0) << parts.err;
    for (const char* form : {" --json", "", " --json --model clip"}) {
      const Outcome whole = shell("fencepost evaluate" + views + form + logs_of(names));
      const Outcome merged = shell(std::string("fencepost evaluate") + form + " --merge a.part b.part");
      EXPECT_EQ(merged.exit_code, 0) << merged.err;
      EXPECT_EQ(merged.out, whole.out) << cut << form;
    }
  }
  EXPECT_EQ(shell("fencepost evaluate --merge a.part b.part --model clip --max-paranoia 0").exit_code, 1);
  EXPECT_EQ(shell("fencepost evaluate --merge a.part missing.part").exit_code, 3);
  EXPECT_EQ(shell("fencepost evaluate --merge a.part --smooth").exit_code, 2);
  EXPECT_TRUE(ends(shell("fencepost evaluate --json " + kLog + " >a.json; fencepost evaluate --merge a.json"), 3,
                   "a.json: no part of an evaluation; write it by 'fencepost evaluate --part'"));
}

TEST(EvaluateCommand, OneBadLogIsNamedAndTheRestIsJudged) {
  ASSERT_EQ(shell("echo text >bad.log; cp " + kScene + " bad.json; cp " + kLog + " alone.log").exit_code, 0);
  const std::string good = kLog + " " + recording("corridor.log");
  const Outcome rest = shell("fencepost evaluate --json " + good);
  const Outcome all = shell("fencepost evaluate --json bad.log " + good + " alone.log");
  EXPECT_EQ(all.exit_code, 3);
  EXPECT_TRUE(holds(all.err, "bad.log: no record in 1 line"));
  EXPECT_TRUE(holds(all.err, "alone.log: no scene alone.json beside it"));
  EXPECT_TRUE(all.err.ends_with("2 of 4 logs could not be judged, see above\n")) << all.err;
  json document = json::parse(all.out);
  EXPECT_EQ(document["unjudged"].size(), 2U);
  EXPECT_EQ(document["unjudged"][0]["log"], "bad.log");
  document.erase("unjudged");
  EXPECT_EQ(document, json::parse(rest.out));

  const Outcome parts =
      shell("fencepost evaluate --part bad.log " + good + " >a.part; fencepost evaluate --merge a.part --json");
  EXPECT_EQ(parts.exit_code, 3);
  EXPECT_EQ(json::parse(parts.out)["unjudged"].size(), 1U);
  EXPECT_TRUE(holds(parts.err, "1 of 3 logs could not be judged"));

  const Outcome none = shell("fencepost evaluate bad.log alone.log");
  EXPECT_EQ(none.exit_code, 3);
  EXPECT_EQ(none.out, "") << "nothing was measured";
  EXPECT_TRUE(holds(none.err, "bad.log: no record") && holds(none.err, "alone.log: no scene")) << none.err;
}

TEST(EvaluateCommand, UsageErrorsEndWithTwo) {
  for (const std::string& arguments : std::vector<std::string>{
           "", kLog + " --views 0", kLog + " --views 2,x", kLog + " --views", kLog + " --max-recklessness 2",
           kLog + " --max-paranoia -0.1", kLog + " --model no_such", kLog + " --scene " + kScene + " --scene " + kScene,
           "-", "- --scene -", kLog + " --profile huge", kLog + " --jobs 0", kLog + " --part --smooth",
           kLog + " --merge x.part"}) {
    const Outcome run = shell("fencepost evaluate " + arguments);
    EXPECT_EQ(run.exit_code, 2) << arguments << "\n" << run.err;
    EXPECT_EQ(run.out, "") << arguments;
    EXPECT_NE(run.err, "") << arguments;
  }
}

TEST(EvaluateCommand, UnreadableInputEndsWithThree) {
  ASSERT_EQ(shell("cp " + kLog + " alone.log; echo '{' >bad.json; echo text >text.log").exit_code, 0);
  for (const std::string& arguments :
       std::vector<std::string>{"alone.log", "missing.log --scene " + kScene, kLog + " --scene missing.json",
                                kLog + " --scene bad.json", "text.log --scene " + kScene, ". --scene " + kScene}) {
    const Outcome run = shell("fencepost evaluate " + arguments);
    EXPECT_EQ(run.exit_code, 3) << arguments << "\n" << run.err;
    EXPECT_EQ(run.out, "") << arguments;
  }
  EXPECT_TRUE(holds(shell("fencepost evaluate alone.log").err, "--scene")) << "says what to try";
}

}  // namespace
}  // namespace fencepost::host
