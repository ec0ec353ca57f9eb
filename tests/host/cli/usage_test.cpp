#include <gtest/gtest.h>

#include <regex>
#include <vector>

#include "tests/host/cli/run.hpp"

namespace fencepost::host {
namespace {

using namespace testing;

const std::vector<std::string> kCommands = {"",
                                            "demo",
                                            "devices",
                                            "replay",
                                            "report",
                                            "simulate",
                                            "evaluate",
                                            "paper",
                                            "import",
                                            "import mrclam",
                                            "import kitti",
                                            "import dlr",
                                            "import rings",
                                            "import cycloid",
                                            "import victoria",
                                            "emulate",
                                            "record",
                                            "run",
                                            "segment",
                                            "train",
                                            "configure",
                                            "calibrate",
                                            "merge",
                                            "smooth",
                                            "doctor",
                                            "help",
                                            "completion",
                                            "import csv",
                                            "import sketch",
                                            "import player",
                                            "import candump",
                                            "import wpilog",
                                            "import mcap"};

TEST(Help, BeginsWithUsageAndEndsWithExamples) {
  for (const std::string& command : kCommands) {
    const Outcome run = shell("fencepost " + command + " --help");
    EXPECT_EQ(run.exit_code, 0) << command;
    EXPECT_EQ(run.out.rfind("Usage: fencepost " + command, 0), 0U) << command << "\n" << run.out;
    const std::size_t options = run.out.find("\nOptions:\n");
    const std::size_t examples = run.out.find("\nExamples:\n  fencepost " + command);
    EXPECT_LT(run.out.find("\n\n"), options) << "a sentence on what it does\n" << run.out;
    EXPECT_LT(options, examples) << run.out;
    EXPECT_NE(examples, std::string::npos) << run.out;
    EXPECT_EQ(run.err, "") << command;
  }
}

TEST(Help, IsSaidWhereNoCommandIsGiven) {
  const Outcome run = shell("fencepost");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.err, shell("fencepost --help").out);
}

TEST(Devices, AreListedByUse) {
  const Outcome all = shell("fencepost devices");
  EXPECT_EQ(all.exit_code, 0) << all.err;
  for (const char* part : {"Cameras of run and record", "\n  cognachrome ", "Odometry of run", "Devices of emulate"}) {
    EXPECT_TRUE(holds(all.out, part)) << part;
  }
  const Outcome one = shell("fencepost devices can");
  EXPECT_FALSE(holds(one.out, "Cameras"));
  EXPECT_TRUE(holds(one.out, "layout=canopen|talon"));
}

TEST(Help, ListsEveryCommand) {
  const std::string out = shell("fencepost --help").out;
  for (const char* name : {"demo", "run", "record", "replay", "report", "simulate", "evaluate", "paper", "emulate",
                           "import", "segment", "configure", "calibrate", "merge", "smooth", "doctor"}) {
    EXPECT_TRUE(holds(out, "\n  " + std::string(name) + " ")) << name;
  }
}

// To what converts numbers, nan and inf are some. Whatever option has a number, by its help.
TEST(Help, NoOptionTakesWhatIsNoNumber) {
  std::size_t tried = 0;
  for (const std::string& command : kCommands) {
    const std::string help = shell("fencepost " + command + " --help").out;
    static const std::regex option("(--[a-z-]+) (D|DEG|DEGREES|F|HZ|M|N|PX|S|T|X|Y)[ \n]");
    for (std::sregex_iterator at(help.begin(), help.end(), option), end; at != end; ++at) {
      for (const char* value : {"nan", "-inf"}) {
        const Outcome run = shell("fencepost " + command + " " + at->str(1) + "=" + value + " x" +
                                  (command == "configure" ? " -o y" : ""));
        EXPECT_EQ(run.exit_code, 2) << command << " " << at->str(1) << ": " << run.err;
        EXPECT_TRUE(holds(run.err, value));
        EXPECT_TRUE(holds(run.err, at->str(1)));
        ++tried;
      }
    }
  }
  EXPECT_GE(tried, 50U);
}

TEST(Version, IsDataOnStandardOutput) {
  const Outcome run = shell("fencepost --version");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.out, "fencepost " FENCEPOST_VERSION "\n");
}

struct Wrong {
  const char* line;
  const char* says;
};

class UsageError : public ::testing::TestWithParam<Wrong> {};

TEST_P(UsageError, ExitsWithTwoAndSaysWhyOnStandardErrorOnly) {
  const Outcome run = shell(GetParam().line);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_EQ(run.out, "");
  EXPECT_TRUE(holds(run.err, GetParam().says));
  EXPECT_LT(run.err.size(), 200U) << "one line a person reads";
}

INSTANTIATE_TEST_SUITE_P(
    All, UsageError,
    ::testing::Values(
        Wrong{"fencepost import", "see fencepost import --help"}, Wrong{"fencepost import --truth x", "--truth"},
        Wrong{"fencepost repaly x", "did you mean replay?"}, Wrong{"fencepost sim x", "did you mean simulate?"},
        Wrong{"fencepost zzzzzz", "no command \"zzzzzz\""}, Wrong{"fencepost import mclram x", "did you mean mrclam?"},
        Wrong{"fencepost --nonsense", "--nonsense"}, Wrong{"fencepost -v", "did you mean -V?"},
        Wrong{"fencepost devices pixie2", "did you mean pixy2?"},
        Wrong{"fencepost replay", "LOG is required; see fencepost replay --help"},
        Wrong{"fencepost replay a --nonsense", "see fencepost replay --help"},
        Wrong{"fencepost replay a --profile huge", "--profile: it takes micro, small, full, not huge"},
        Wrong{"fencepost replay a --frames 0", "0 is not a number above 0"},
        Wrong{"fencepost replay a --frames -3", "-3 is not a number above 0"},
        Wrong{"fencepost replay a --pose-noise 1", "--pose-noise"},
        Wrong{"fencepost replay a --pose-noise 1,0", "0 is not a number above 0"},
        Wrong{"fencepost replay a --from soon", "soon"},
        Wrong{"fencepost replay a --from 3 --to 1", "--from is later than --to"},
        Wrong{"fencepost replay - --camera -", "cannot both be standard input"},
        Wrong{"fencepost replay a --write-log -", "cannot both be standard output"},
        Wrong{"fencepost import mrclam d --poses maybe", "maybe"},
        Wrong{"fencepost import sketch t --rate 1e-9", "--rate: it takes 0.1 to 1000, not 1e-9"},
        Wrong{"fencepost import sketch t --rate 1001", "--rate: it takes 0.1 to 1000, not 1001"},
        Wrong{"fencepost export a --every -1", "--every: it takes 0 or more, not -1"},
        Wrong{"fencepost export a -o ''", "--output: its value is empty"},
        Wrong{"fencepost replay ''", "LOG: its value is empty"},
        Wrong{"fencepost replay a --from 1 --from 2", "--from: given twice"},
        Wrong{"fencepost replay a b", "b: it takes one LOG; report, merge and evaluate take several"},
        Wrong{"fencepost completion tcsh", "it takes bash, zsh, fish, not tcsh"},
        Wrong{"fencepost replay --diff a.log", "--diff: it needs 2 values, and 1 is there"},
        Wrong{"fencepost emulate pixy2 a --seed x", "--seed: x is not a number"},
        Wrong{"fencepost configure a robot.width=0.2 -o b", "robot.width=0.2: write --set before a setting"},
        Wrong{"fencepost export a -o b.geojson --at 95,13", "--at: 95 is no latitude"},
        Wrong{"fencepost import kitti d --scale 0", "0 is not a number"},
        Wrong{"fencepost import mrclam d --diameter 0", "0 is not a number"}));

class Unreadable : public ::testing::TestWithParam<Wrong> {};

TEST_P(Unreadable, ExitsWithThreeAndWritesNothing) {
  spill("empty", "");
  spill("foreign", "hello\nworld\n");
  spill("utf16", std::string("\xFF\xFEt\0,\0x\0\r\0\n\0", 12));
  spill("cr", "$FPHDR,1\r$FPODO,1\r");
  spill("scene.json", "{\"format\": 1, }");
  const Outcome run = shell(GetParam().line);
  EXPECT_EQ(run.exit_code, 3) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_TRUE(holds(run.err, GetParam().says));
  EXPECT_FALSE(std::filesystem::exists(folder() / "result"));
}

INSTANTIATE_TEST_SUITE_P(
    All, Unreadable,
    ::testing::Values(Wrong{"fencepost replay missing.log -o result", "cannot read missing.log: No such file"},
                      Wrong{"fencepost replay . -o result", "name a file inside it"},
                      Wrong{"fencepost replay empty -o result", "empty"},
                      Wrong{"fencepost replay foreign -o result", "foreign: no record"},
                      Wrong{"fencepost replay utf16 -o result", "utf16: it is UTF-16, as PowerShell's > writes text"},
                      Wrong{"fencepost import csv utf16 --camera pixy2 -o result", "it is UTF-16"},
                      Wrong{"fencepost replay cr -o result", "cr: its lines end with CR alone"},
                      Wrong{"fencepost replay foreign --json -o result", "foreign: no record"},
                      Wrong{"fencepost replay - -o result", "standard input: empty"},
                      Wrong{"fencepost replay foreign --camera missing -o result", "cannot read missing"},
                      Wrong{"fencepost replay foreign --camera foreign -o result", "foreign: has no calibration"},
                      Wrong{"fencepost import csv foreign --camera pixi2 -o result", "did you mean pixy2?"},
                      Wrong{"fencepost evaluate missing.log -o result", "cannot read missing.log: No such file"},
                      Wrong{"fencepost evaluate . -o result", "name a file inside it"},
                      Wrong{"fencepost report foreign -o result", "foreign: no record"},
                      Wrong{"fencepost report foreign --scene scene.json -o result", "scene.json: line 1"},
                      Wrong{"fencepost simulate missing.json -o result", "cannot read missing.json"},
                      Wrong{"fencepost simulate scene.json -o result", "scene.json: line 1"},
                      Wrong{"fencepost import mrclam . -o result", "RobotN_Measurement.dat"},
                      Wrong{"fencepost import kitti . -o result", "calib.txt"},
                      Wrong{"fencepost import rings missing.csv -o result", "missing.csv"},
                      Wrong{"fencepost import rings foreign -o result", "foreign"},
                      Wrong{"FENCEPOST_SHARE=/nowhere fencepost demo -o result", "set FENCEPOST_SHARE"}));

}  // namespace
}  // namespace fencepost::host
