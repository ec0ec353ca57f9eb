// The commands when all is well.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/host/cli/run.hpp"

namespace fencepost::host {
namespace {

using nlohmann::json;
using namespace testing;

const std::string kLog = recording("approach_stop.log");
const std::string kScene = recording("approach_stop.json");

TEST(Replay, PrintsAlertsThenObjectsThenASummary) {
  const Outcome run = shell("fencepost replay " + kLog);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const std::size_t stop = run.out.find("STOP    red");
  const std::size_t table = run.out.find(" id name ");
  const std::size_t summary = run.out.find("profile full, digest ");
  ASSERT_NE(stop, std::string::npos) << run.out;
  ASSERT_NE(summary, std::string::npos) << run.out;
  EXPECT_LT(stop, table);
  EXPECT_LT(table, summary);
  EXPECT_FALSE(holds(run.out, "\x1b")) << "no colours into a file";
  EXPECT_EQ(run.err, "");
}

TEST(Replay, JsonIsTheResultDocument) {
  const Outcome run = shell("fencepost replay " + kLog + " --json");
  const json document = json::parse(run.out);
  EXPECT_EQ(document["format"], 1);
  EXPECT_EQ(document["profile"], "full");
  EXPECT_GT(document["log"]["frames"], 0);
  EXPECT_FALSE(document["objects"].empty());
  EXPECT_FALSE(document["alerts"].empty());
  EXPECT_EQ(shell("fencepost replay - --json <" + kLog).out, run.out) << "standard input is the same";
  EXPECT_EQ(shell("fencepost replay " + kLog + " --json -o r.json").out, "");
  EXPECT_EQ(slurp("r.json"), run.out);
}

TEST(Replay, LimitsWhatIsRead) {
  const json whole = json::parse(shell("fencepost replay " + kLog + " --json").out);
  const json ten = json::parse(shell("fencepost replay " + kLog + " --json --frames 10").out);
  EXPECT_EQ(ten["log"]["frames"], 10);
  EXPECT_NE(ten["digest"], whole["digest"]);
  const json early = json::parse(shell("fencepost replay " + kLog + " --json --to 4").out);
  for (const json& alert : early["alerts"]) EXPECT_LE(alert["t"], 4.5);
  EXPECT_LT(early["alerts"].size(), whole["alerts"].size());
}

TEST(Replay, AProfileMayBeChosen) {
  const Outcome run = shell("fencepost replay " + kLog + " --json --profile micro");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(json::parse(run.out)["profile"], "micro");
}

TEST(Replay, ItsOwnLogChecks) {
  ASSERT_EQ(shell("fencepost replay " + kLog + " --write-log own.log").exit_code, 0);
  EXPECT_TRUE(ends(shell("fencepost replay own.log --check"), 0, "check passed"));
}

TEST(Replay, ACheckFailsOnALogThatDiffers) {
  ASSERT_EQ(shell("fencepost replay " + kLog + " --write-log own.log").exit_code, 0);
  // Without one of the frames the robot's own records cannot come out the same.
  ASSERT_EQ(shell("awk '!/^.FPFRM/ || ++n != 40' own.log >other.log; ! cmp -s own.log other.log").exit_code, 0);
  const Outcome run = shell("fencepost replay other.log --check");
  EXPECT_EQ(run.exit_code, 1) << run.err;
  EXPECT_TRUE(holds(run.err, "check failed"));
  EXPECT_NE(run.out, "");
}

// The other records agree, and what the damaged one said is not known.
TEST(Replay, ACheckFailsWhereARecordOfTheRobotsIsDamaged) {
  ASSERT_EQ(shell("fencepost replay " + kLog + " --write-log own.log").exit_code, 0);
  for (const char* damage : {"/^.FPALR/s/,/;/3", "/^.FPALR/s/FPALR/FPXLR/", "/^.FPALR/s/FPALR/XPALR/",
                             "/^.FPDIG/s/.$/x/", "/^.FPALR/s/^.FPALR/%FPALR/"}) {
    const Outcome run = shell(std::string("sed '") + damage +
                              "' own.log >bad.log; ! cmp -s own.log bad.log && fencepost replay bad.log --check");
    EXPECT_EQ(run.exit_code, 1) << damage << run.err;
    EXPECT_TRUE(holds(run.err, "of the robot's own records cannot be read, first in line ")) << damage << run.err;
  }
  // A line of a program's own, a newer version's record, a cut end.
  const Outcome fine = shell(
      "sed 's/^.FPSIG/hello\\n&/' own.log >more.log; printf '$FPALR,1' >>more.log; fencepost replay more.log --check");
  EXPECT_EQ(fine.exit_code, 0) << fine.err;
}

TEST(Replay, ACheckOfNothingFails) {
  EXPECT_TRUE(ends(shell("fencepost replay " + kLog + " --check"), 1, "nothing to compare"));
}

TEST(Replay, TellsRejectsByReasonWithTheirFirstLine) {
  ASSERT_EQ(shell("sed '5s/,/;/2; 9s/,/;/2' " + kLog + " >bad.log").exit_code, 0);
  const Outcome run = shell("fencepost replay bad.log --json");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(holds(run.err, "2 lines rejected: crc, first in line 5 ("));
  EXPECT_EQ(json::parse(run.out)["log"]["rejected"]["crc"], 2);
}

TEST(Replay, ALogWithoutCalibrationNeedsACamera) {
  ASSERT_EQ(shell("grep -v FPCAM " + kLog + " >nocam.log; grep FPCAM " + kLog + " | head -1 >cam").exit_code, 0);
  const Outcome without = shell("fencepost replay nocam.log");
  EXPECT_EQ(without.exit_code, 3);
  EXPECT_EQ(without.out, "");
  EXPECT_TRUE(holds(without.err, "--camera"));
  const std::string whole = shell("fencepost replay " + kLog).out;
  EXPECT_EQ(shell("fencepost replay nocam.log --camera cam").out, whole);
  EXPECT_EQ(shell("fencepost replay nocam.log --camera " + kScene).out, whole);
  EXPECT_EQ(shell("fencepost replay nocam.log --camera - <cam").out, whole);
  const json scene = json::parse(slurp(FENCEPOST_SOURCE_DIR "/host/share/recordings/approach_stop.json"));
  spill("camera.json", json{{"camera", scene["camera"]}}.dump());
  EXPECT_EQ(shell("fencepost replay nocam.log --camera camera.json").out, whole) << "as `segment` reads it";
}

TEST(Simulate, GivesTheBundledRecordingAndFeedsReplay) {
  const Outcome run = shell("fencepost simulate " + kScene + " -o my.log && cmp my.log " + kLog);
  EXPECT_EQ(run.exit_code, 0) << run.err << run.out;
  const Outcome piped = shell("fencepost simulate - <" + kScene + " | fencepost replay - --json");
  EXPECT_EQ(piped.exit_code, 0) << piped.err;
  EXPECT_EQ(piped.out, shell("fencepost replay " + kLog + " --json").out);
}

TEST(Report, WritesThePageBesideUnlessToldWhere) {
  const Outcome run = shell("cp " + kLog + " run.log; mkdir sub; cd sub; fencepost report ../run.log");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_TRUE(holds(run.err, "wrote run.html"));
  const std::string page = slurp(folder() / "sub" / "run.html");
  EXPECT_TRUE(holds(page, R"(id="given">{"logs":[{"name":"run.log","log":"H4sI)"));  // as gzip packs, in base 64
  EXPECT_TRUE(holds(page, "default-src 'none'; script-src 'sha256-"));
  EXPECT_TRUE(holds(page, "connect-src 'none'"));
  const Outcome piped = shell("fencepost report run.log --profile small -o - --scene - <" + kScene);
  EXPECT_EQ(piped.exit_code, 0) << piped.err;
  EXPECT_TRUE(holds(piped.out, R"("scene":{"format":1)"));
  EXPECT_TRUE(holds(piped.out, R"("profile":"small"})"));
}

TEST(Simulate, OneOfAThingIsNamedAsOne) {
  spill("one.json", R"({"format": 1,
    "camera": {"width": 160, "height": 120, "fx": 150, "fy": 150, "cx": 79.5, "cy": 59.5, "mount": {"z": 0.1}},
    "signatures": [{"id": 1, "rgb": "d02020"}],
    "objects": [{"signature": 1, "height": 0.2, "footprint": {"circle": [1, 0, 0.05]}}],
    "path": {"type": "poses", "poses": [{"t": 0, "x": 0, "y": 0, "heading": 0},
                                        {"t": 0.001, "x": 0, "y": 0, "heading": 0}]}})");
  EXPECT_EQ(shell("fencepost simulate one.json -o one.log").err, "0.0 s: 1 frame with 1 blob, 2 odometry samples\n");
  EXPECT_TRUE(holds(shell("fencepost evaluate one.log").out, "object 1, tentative, 1 of 1 frame\n"));
}

TEST(Report, PutsSeveralLogsSideBySide) {
  const Outcome run = shell("cp " + kLog +
                            " a.log; sed '5s/,/;/2' a.log >b.log; echo foreign >c.log; "
                            "fencepost report a.log b.log c.log");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(holds(run.err, "wrote fencepost-report.html"));
  EXPECT_TRUE(holds(run.err, "b.log: 1 line rejected: crc"));
  EXPECT_TRUE(holds(run.err, "c.log: no record"));
  const std::string page = slurp("fencepost-report.html");
  for (const char* name : {"a.log", "b.log", "c.log"}) EXPECT_TRUE(holds(page, R"({"name":")" + std::string(name)));
  EXPECT_TRUE(ends(shell("fencepost report a.log b.log --scene " + kScene), 2,
                   "2 logs and 1 scene; give one --scene for each log"));
  EXPECT_EQ(shell("fencepost report a.log b.log --scene " + kScene + " --scene " + kScene).exit_code, 0);
  EXPECT_EQ(shell("fencepost report - b.log --scene - </dev/null").exit_code, 2);
}

// As `evaluate` does it: one log that cannot be read takes nothing from the others.
TEST(Report, LeavesOutALogThatCannotBeReadAndSaysSo) {
  const Outcome run = shell("cp " + kLog +
                            " a.log; gzip -c a.log | head -c 2000 > cut.gz; "
                            "fencepost report cut.gz a.log nofile.log . -o r.html");
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_TRUE(holds(run.err, "wrote r.html"));
  for (const char* left_out :
       {"left out: cannot read cut.gz", "left out: cannot read nofile.log", "left out: cannot read .:"}) {
    EXPECT_TRUE(holds(run.err, left_out));
  }
  const std::string page = slurp("r.html");
  EXPECT_TRUE(holds(page, R"({"name":"a.log")"));
  EXPECT_FALSE(holds(page, "nofile.log"));
  const Outcome none = shell("fencepost report nofile.log cut.gz -o none.html");
  EXPECT_EQ(none.exit_code, 3);
  EXPECT_TRUE(holds(none.err, "fencepost: cannot read nofile.log: "));
  EXPECT_FALSE(std::filesystem::exists(folder() / "none.html"));
}

TEST(Report, StaticHasNoScriptAndMeasuresTheModels) {
  const Outcome run = shell("cp " + kLog + " run.log; fencepost report run.log --static --scene " + kScene);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const std::string page = slurp("run.html");
  EXPECT_TRUE(holds(page, "<h1>run.log</h1>"));
  EXPECT_TRUE(holds(page, "Against the truth"));
  EXPECT_FALSE(holds(page, "<script"));
  EXPECT_EQ(shell("fencepost report run.log run.log --static").exit_code, 2);
}

// The camera that the command line gives is in the page's log.
TEST(Report, ALogWithoutCalibrationTakesACamera) {
  const std::string make = "grep -v FPCAM " + kLog + " >nocam.log; grep FPCAM " + kLog + " | head -1 >cam; ";
  EXPECT_EQ(shell(make + "fencepost report nocam.log").exit_code, 3);
  EXPECT_EQ(shell("fencepost report nocam.log --camera cam").exit_code, 0);
  const json given = [&] {
    const std::string page = slurp("nocam.html");
    const std::string open = R"(id="given">)";
    const std::size_t begin = page.find(open) + open.size();
    return json::parse(page.substr(begin, page.find("</script>", begin) - begin));
  }();
  spill("base64", given["logs"][0]["log"].get<std::string>());
  const std::string whole = shell("fencepost replay nocam.log --camera cam --json").out;
  EXPECT_EQ(json::parse(shell("base64 -d base64 | fencepost replay - --json").out)["digest"],
            json::parse(whole)["digest"]);
}

json given_in(const std::string& page) {
  const std::string open = R"(id="given">)";
  const std::size_t begin = page.find(open) + open.size();
  return json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

// Noise that gzip cannot pack, as lines that are no records.
const std::string kNoise = "head -c 2000000 /dev/urandom | base64";

TEST(Report, ALongLogIsThinnedToTwoMegabytesAndSaysSo) {
  const Outcome run = shell("{ cat " + kLog + "; " + kNoise + "; } >long.log; fencepost report long.log");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(holds(run.err, "thinned to fit 2 MB: "));
  EXPECT_TRUE(holds(run.err, "poses, all 12 alerts, map and camera at "));
  EXPECT_TRUE(holds(run.err, "all of it: fencepost report --whole"));
  const std::string page = slurp("long.html");
  EXPECT_LT(page.size(), 2'000'000U);
  const json given = given_in(page);
  EXPECT_FALSE(given["logs"][0].contains("log"));
  spill("base64", given["logs"][0]["thinned"].get<std::string>());
  const json kept = json::parse(shell("base64 -d base64 | gzip -d").out);
  const json whole = json::parse(shell("fencepost replay long.log --json").out);
  EXPECT_EQ(kept["result"]["digest"], whole["digest"]);
  EXPECT_EQ(kept["result"]["alerts"], whole["alerts"]);
  EXPECT_EQ(kept["result"]["objects"], whole["objects"]);
  EXPECT_EQ(kept["alerts"], whole["alerts"].size());

  const Outcome all = shell("fencepost report long.log --whole");
  EXPECT_EQ(all.exit_code, 0) << all.err;
  EXPECT_FALSE(holds(all.err, "thinned"));
  spill("base64", given_in(slurp("long.html"))["logs"][0]["log"].get<std::string>());
  EXPECT_EQ(shell("base64 -d base64 | gzip -d | cmp - long.log").exit_code, 0);
  EXPECT_EQ(shell("fencepost report long.log --whole --static").exit_code, 2);
}

TEST(Report, ShortLogsAreWholeBesideLongOnes) {
  const Outcome run = shell("cp " + kLog + " short.log; { cat " + kLog + "; " + kNoise +
                            "; } >long.log; cat long.log | fencepost report long.log - short.log -o r.html");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(holds(run.err, "long.log: thinned to fit"));
  EXPECT_TRUE(holds(run.err, "standard input: thinned to fit"));
  EXPECT_FALSE(holds(run.err, "short.log: thinned"));
  const std::string page = slurp("r.html");
  EXPECT_LT(page.size(), 2'000'000U);
  const json given = given_in(page);
  EXPECT_TRUE(given["logs"][0].contains("thinned"));
  EXPECT_TRUE(given["logs"][1].contains("thinned"));
  spill("base64", given["logs"][2]["log"].get<std::string>());
  EXPECT_EQ(shell("base64 -d base64 | gzip -d | cmp - short.log").exit_code, 0);
}

TEST(Report, SaysWhatIsMissing) {
  EXPECT_TRUE(ends(shell("FENCEPOST_SHARE=/nowhere fencepost report " + kLog + " -o run.html"), 3,
                   "the page is missing; looked in /nowhere/page"));
  EXPECT_EQ(shell("fencepost report " + kLog + " --scene " + kLog).exit_code, 3);
}

TEST(Demo, ShowsAlertsObjectsAndThePage) {
  const Outcome run = shell("fencepost demo");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(holds(run.out, "STOP"));
  EXPECT_TRUE(holds(run.out, " id name "));
  EXPECT_TRUE(holds(run.out, "conf hybrid\n")) << "no second area, which contradicts the first";
  EXPECT_FALSE(holds(run.out, "digest"));
  EXPECT_TRUE(holds(run.err, "Wrote fencepost-demo.html"));
  EXPECT_TRUE(holds(run.err, "Next:\n  fencepost "));
  EXPECT_TRUE(holds(slurp("fencepost-demo.html"), R"({"logs":[{"name":"go_around.log")"));
}

// README.md shows the first five lines, indented by four.
TEST(Demo, PrintsWhatTheReadmeShows) {
  const Outcome run = shell("fencepost demo");
  std::string shown;
  std::istringstream lines(run.out);
  std::string line;
  for (int i = 0; i < 5 && std::getline(lines, line); ++i) shown += "    " + line + "\n";
  ASSERT_GT(shown.size(), 250U) << run.err;
  EXPECT_TRUE(holds(slurp(FENCEPOST_SOURCE_DIR "/README.md"), shown)) << "not in README.md:\n" << shown;
}

TEST(Import, RingsGiveALogThatReplays) {
  std::string csv =
      "frame,cam_x,cam_y,cam_heading,bearing_lo,bearing_hi,lo_touches_border,hi_touches_border,excluded\n";
  // Six views from 1 m, looking at a disc of radius 0.1 at the origin: half its angle is asin(0.1) = 0.1002 rad.
  for (int i = 0; i < 6; ++i) {
    const double angle = 0.5 * i;
    csv += std::to_string(i) + "," + std::to_string(std::cos(angle)) + "," + std::to_string(std::sin(angle)) + "," +
           std::to_string(angle - 3.14159265) + ",-0.1002,0.1002,0,0,0\n";
  }
  spill("disc.csv", csv);
  const Outcome run = shell("fencepost import rings disc.csv | fencepost replay - --json");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json object = json::parse(run.out)["objects"].at(0);
  EXPECT_NEAR(object["models"]["cylinder"]["x"].get<double>(), 0, 0.02);
  EXPECT_NEAR(object["models"]["cylinder"]["y"].get<double>(), 0, 0.02);
  EXPECT_NEAR(object["models"]["cylinder"]["radius"].get<double>(), 0.1, 0.02);
}

}  // namespace
}  // namespace fencepost::host
