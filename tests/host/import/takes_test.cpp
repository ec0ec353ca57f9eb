// Importers of blobs and poses, each on a text as the vendor's own program prints it, with garbage between.
#include <gtest/gtest.h>

#include <lz4frame.h>
#include <zstd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "host/import/candump/candump.hpp"
#include "host/import/csv/csv.hpp"
#include "host/import/mcap/mcap.hpp"
#include "host/import/player/player.hpp"
#include "host/import/sketch/sketch.hpp"
#include "tests/host/import/takes.hpp"

namespace fencepost::host {
namespace {

TEST(ImportSketch, ReadsWhatPixy2sExamplePrintsUnderTheMonitorsTimes) {
  const std::string text =
      "23:59:59.900 -> Starting...\r\n"
      "23:59:59.950 -> Detected 2\r\n"
      "23:59:59.951 ->   block 0: sig: 1 x: 159 y: 99 width: 20 height: 30 index: 3 age: 120\r\n"
      "23:59:59.952 ->   block 1: sig: 3 x: 40 y: 60 width: 11 height: 9 index: 4 age: 7\r\n"
      "23:59:59.953 -> \xff\xfe\x01 noise \x1b[2J\r\n"
      "00:00:00.030 -> Detected 1\r\n"
      "00:00:00.031 ->   block 0: CC block sig: 12 (10 decimal) x: 1 y: 2 width: 3 height: 4 angle: 5 index: 1 age: "
      "2\r\n"
      "00:00:00.110 -> Detected 1\r\n"
      "00:00:00.111 ->   block 0: sig: 1 x: 160 y: 99 wid\r\n";
  const ImportResult result = import_sketch(text, "monitor.txt", settings());
  const Recorded log = recorded(result);
  ASSERT_EQ(log.frames.size(), 3U);
  ASSERT_EQ(log.frames[0].blobs.size(), 2U);
  expect_box(log.frames[0].blobs[0], 1, 149, 84, 168, 114);
  expect_box(log.frames[0].blobs[1], 3, 35, 56, 45, 65);
  EXPECT_EQ((log.frames[1].t - log.frames[0].t).raw, 800) << "over midnight";
  EXPECT_EQ(log.frames[2].blobs.size(), 0U) << "its block was cut off";
  EXPECT_EQ(skipped(result, "lines of no known form"), 3U);
  EXPECT_EQ(skipped(result, "colour codes"), 1U);
}

TEST(ImportSketch, MakesTimesUpWhereThereAreNoneAndSaysSo) {
  TakeSettings ten = settings();
  ten.rate = 10;
  const ImportResult result = import_sketch(
      "  block 0: sig: 1 x: 159 y: 99 width: 20 height: 30 index: 3 age: 120\n"
      "  block 1: sig: 2 x: 50 y: 99 width: 20 height: 30 index: 3 age: 120\n"
      "  block 0: sig: 1 x: 161 y: 99 width: 20 height: 30 index: 3 age: 121\n",
      "monitor.txt", ten);
  const Recorded log = recorded(result);
  ASSERT_EQ(log.frames.size(), 2U) << "without announcements block 0 begins a frame";
  EXPECT_EQ(log.frames[0].blobs.size(), 2U);
  EXPECT_EQ((log.frames[1].t - log.frames[0].t).raw, 1'000);
  ASSERT_EQ(result->summary.notes.size(), 2U);
  EXPECT_NE(result->summary.notes[0].find("10 times a second"), std::string::npos) << result->summary.notes[0];
  EXPECT_NE(result->summary.notes[1].find("stand still"), std::string::npos);
}

TEST(ImportSketch, RefusesARateAtWhichFramesLastForYears) {
  TakeSettings slow = settings();
  slow.rate = 1e-9;
  const ImportResult result = import_sketch("Detected 0\nDetected 0\n", "monitor.txt", slow);
  ASSERT_FALSE(result.ok());
  EXPECT_NE(result.error().what.find("has a gap of 1000000000 s"), std::string::npos) << result.error().message();
}

TEST(ImportSketch, RefusesAClockThatRunsBackwards) {
  const ImportResult result =
      import_sketch("23:00:00.000 -> Detected 0\n22:00:00.000 -> Detected 0\n21:00:00.000 -> Detected 0\n",
                    "monitor.txt", settings());
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().message(),
            "monitor.txt:2: has an earlier time than a line above it; save each recording to a file of its own");
}

TEST(ImportSketch, TakesNoStampThatIsNoTime) {
  const ImportResult result = import_sketch(
      "25:99:99.999 -> Detected 1\nDetected 1\n  block 0: sig: 1 x: 159 y: 99 "
      "width: 20 height: 30 index: 3 age: 120\n",
      "m.txt", settings());
  ASSERT_TRUE(result.ok()) << result.error().message();
  EXPECT_EQ(skipped(result, "lines of no known form"), 1U);
}

TEST(ImportSketch, AllowsAClockThatIsPutBackALittle) {
  const Recorded log =
      recorded(import_sketch("12:00:01.000 -> Detected 0\n12:00:00.500 -> Detected 0\n12:00:01.100 -> Detected 0\n",
                             "monitor.txt", settings()));
  ASSERT_EQ(log.frames.size(), 2U);
  EXPECT_EQ((log.frames[1].t - log.frames[0].t).raw, 1'000);
}

TEST(ImportSketch, ReadsWhatTheHuskyLensExamplePrints) {
  const ImportResult result = import_sketch(
      "12:00:00.000 -> ###########\n"
      "12:00:00.000 -> Block:xCenter=160,yCenter=120,width=40,height=20,ID=1\n"
      "12:00:00.001 -> Block:xCenter=50,yCenter=60,width=10,height=10,ID=0\n"
      "12:00:00.050 -> Arrow:xOrigin=1,yOrigin=2,xTarget=3,yTarget=4,ID=1\n"
      "12:00:00.100 -> No block or arrow appears on the screen!\n"
      "12:00:00.150 -> Fail to request data from HUSKYLENS, recheck the connection!\n"
      "12:00:00.200 -> ###########\n"
      "12:00:00.200 -> Block:xCenter=162,yCenter=120,width=40,height=20,ID=2\n",
      "monitor.txt", settings(320, 240));
  const Recorded log = recorded(result);
  ASSERT_EQ(log.frames.size(), 3U);
  ASSERT_EQ(log.frames[0].blobs.size(), 1U);
  expect_box(log.frames[0].blobs[0], 1, 140, 110, 179, 129);
  EXPECT_EQ(log.frames[1].blobs.size(), 0U);
  EXPECT_EQ(log.frames[2].blobs[0].signature, 2);
  EXPECT_EQ(skipped(result, "blocks that were not learned"), 1U);
  EXPECT_EQ(skipped(result, "lines of no known form"), 1U);
}

TEST(ImportSketch, ReadsTrackingPacketsOfCmucams) {
  const Recorded log = recorded(import_sketch(
      "ACK\n:T 44 70 40 60 48 80 120 200\nT 44 70 40 60 48 80 120 200\nT 0 0 0 0 0 0 0 0\n45 71 41 61 49 81 120 200 "
      "\nT 44 70\n",
      "monitor.txt", settings(88, 143)));
  ASSERT_EQ(log.frames.size(), 3U);
  expect_box(log.frames[0].blobs[0], 1, 40, 60, 48, 80);
  EXPECT_EQ(log.frames[0].blobs[0].cy.to_double(), 70);
  EXPECT_EQ(log.frames[1].blobs.size(), 0U);
  expect_box(log.frames[2].blobs[0], 1, 41, 61, 49, 81);
}

TEST(ImportSketch, RefusesATextThatHasNothingKnown) {
  const ImportResult result = import_sketch("hello\nworld\n", "monitor.txt", settings());
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().where, "monitor.txt");
  TakeSettings no_camera;
  const ImportResult blind = import_sketch("Detected 1\n", "monitor.txt", no_camera);
  ASSERT_FALSE(blind.ok());
  EXPECT_NE(blind.error().remedy.find("--camera"), std::string::npos);
}

TEST(ImportCsv, CentresWithoutAWidthAreBearings) {
  const ImportResult result = import_csv("t,sig,cx,cy\n1,3,100.3,50\n1,4,316,50\n1.1,,,\n", "b.csv", settings());
  const Recorded log = recorded(result);
  ASSERT_EQ(log.frames.size(), 2U);
  ASSERT_EQ(log.frames[0].blobs.size(), 1U);
  EXPECT_TRUE(log.frames[0].blobs[0].bearing);
  EXPECT_EQ(log.frames[0].blobs[0].cx.raw, 1'003);
  expect_box(log.frames[0].blobs[0], 3, 100, 50, 101, 50);
  EXPECT_TRUE(log.frames[1].blobs.empty());
  EXPECT_EQ(skipped(result, "blobs outside the image"), 1U);
  const Recorded mixed =
      recorded(import_csv("t,x1,y1,x2,y2,cx,cy\n1,10,20,30,40,20,30\n1,,,,,200,30\n", "b.csv", settings()));
  ASSERT_EQ(mixed.frames.size(), 1U);
  ASSERT_EQ(mixed.frames[0].blobs.size(), 2U);
  EXPECT_FALSE(mixed.frames[0].blobs[0].bearing);
  EXPECT_TRUE(mixed.frames[0].blobs[1].bearing);
}

TEST(ImportCsv, GoesByTheNamesOfColumns) {
  const std::string text = "\xEF\xBB\xBF# from a spreadsheet\r\nWidth;Height;Time;X;Y;Colour;note\r\n20;30;1,5\r\n";
  const ImportResult wrong = import_csv(text, "blobs.csv", settings());
  ASSERT_FALSE(wrong.ok());
  EXPECT_EQ(wrong.error().where, "blobs.csv:3");
  EXPECT_EQ(wrong.error().what, "has 3 columns instead of 7");
  const Recorded log =
      recorded(import_csv("# a "
                          "comment\n\nWidth;Height;Time;X;Y;Colour;note\n20;30;1.5;100;90;red;a\n10;10;1.5;50;50;green;"
                          "b\n20;30;1.6;104;90;red;c\n",
                          "blobs.csv", settings()));
  ASSERT_EQ(log.frames.size(), 2U);
  ASSERT_EQ(log.frames[0].blobs.size(), 2U);
  expect_box(log.frames[0].blobs[0], 1, 90, 75, 109, 104);
  EXPECT_EQ(log.frames[0].blobs[1].signature, 2);
  ASSERT_EQ(log.signatures.size(), 2U);
  EXPECT_EQ(log.signatures[0].name.view(), "red");
}

TEST(ImportCsv, TakesInclusiveBoxesEmptyFramesAndPosesOfTheSameClock) {
  TakeSettings with_poses = settings();
  with_poses.poses = parse_pose_table("heading,y,x,t\n0.1,2,1,10\n0.2,2.5,1.5,10.1\n0.3,3,2,10.2\n", "poses.csv");
  const ImportResult result =
      import_csv("t,sig,x1,y1,x2,y2\n10.05,4,1,2,30,40\n10.15,,,,,\n10.15,4,400,2,500,3\n", "blobs.csv", with_poses);
  const Recorded log = recorded(result);
  ASSERT_EQ(log.frames.size(), 2U);
  expect_box(log.frames[0].blobs[0], 4, 1, 2, 30, 40);
  EXPECT_EQ(log.frames[0].t.raw, 500);
  EXPECT_EQ(log.frames[1].blobs.size(), 0U);
  EXPECT_EQ(skipped(result, "blobs outside the image"), 1U);
  ASSERT_EQ(log.odometry.size(), 3U);
  EXPECT_EQ(log.odometry[1].x.to_double(), 1.5);
  EXPECT_EQ(log.odometry[1].heading.to_double(), 0.2);
}

TEST(ImportCsv, NamesTheColumnOrTheNumberThatIsWrong) {
  const auto error = [](const char* text) { return import_csv(text, "b.csv", settings()).error().message(); };
  EXPECT_EQ(
      error("x,y,width,height\n1,2,3,4\n"),
      "b.csv:1: has no column \"t\"; name it in the first line; known names of it: t, time, timestamp, seconds, sec");
  EXPECT_EQ(error("t,x,y,w,h\n1,2,abc,4,5\n"), "b.csv:2: \"abc\" is not a number; correct the line or take it out");
  EXPECT_NE(error("t,x1,y1,x2,y2,cx,cy\n1,,,,,5,\n").find("b.csv:2: is a centre of which one number is missing"),
            std::string::npos);
  EXPECT_NE(error("t,x1,y1,x2,y2,cx,cy\n1,5,1,,2,5,5\n").find("b.csv:2: \"\" is not a number"), std::string::npos);
  EXPECT_NE(error("t,cx,cy\n1,nan,5\n").find("b.csv:2: \"nan\" is not a number"), std::string::npos);
  EXPECT_NE(error("t,x1,y1,x2,y2\n1,9,2,3,4\n").find("b.csv:2: is a box of no size"), std::string::npos);
  EXPECT_NE(error("t,sig,x,y,w,h\n1,300,50,50,3,4\n").find("signature 300"), std::string::npos);
  EXPECT_NE(error("\n# nothing\n").find("has no rows"), std::string::npos);
}

TEST(ImportCsv, TakesPosesAsTumWritesThem) {
  const auto poses = parse_pose_table(
      "# timestamp tx ty tz qx qy qz qw\n1305031102.1 1.5 -2 0.3 0 0 0.7071067811865476 0.7071067811865476\n",
      "gt.txt");
  ASSERT_EQ(poses.size(), 1U);
  EXPECT_NEAR(poses[0].heading, std::acos(0.0), 1e-12);
  EXPECT_EQ(poses[0].y, -2);
  EXPECT_THROW(parse_pose_table("1 2 3 4 5 6 7 8\n1 2 3\n", "gt.txt"), ImportError);
}

/// `rows` frames, `step` apart from `begin` on.
std::string table(double begin, double step, int rows) {
  std::string text = "t,x,y,w,h\n";
  for (int i = 0; i < rows; ++i) {
    std::array<char, 80> line{};
    std::snprintf(line.data(), line.size(), "%.0f,100,100,20,20\n", begin + step * i);
    text += line.data();
  }
  return text;
}

std::string refusal(const ImportResult& result) { return result.ok() ? "imported" : result.error().message(); }

struct Times {
  double begin;
  double step;
  int rows;
  const char* says;
};
class ForeignTimes : public ::testing::TestWithParam<Times> {};

TEST_P(ForeignTimes, AreRefusedWithAGuess) {
  const auto& [begin, step, rows, says] = GetParam();
  EXPECT_EQ(refusal(import_csv(table(begin, step, rows), "b.csv", settings())), says);
}
INSTANTIATE_TEST_SUITE_P(
    All, ForeignTimes,
    ::testing::Values(
        Times{1.764e18, 33'554'432, 60,
              "b.csv: times go up by 33554432 between rows; are they nanoseconds? The importer reads seconds"},
        Times{0, 33'333, 60,
              "b.csv: times go up by 33333 between rows; are they microseconds? The importer reads seconds"},
        Times{0, 33, 600, "b.csv: times go up by 33 between rows; are they milliseconds? The importer reads seconds"},
        Times{0, 1'764e6, 2,
              "b.csv: has a gap of 1764000000 s behind the time 0.000 s; leave out the rows before it or behind it; "
              "frames and poses need one clock"},
        Times{0, 1e15, 2,
              "b.csv: has a gap of 1000000000000000 s behind the time 0.000 s; leave out the rows before it or behind "
              "it; frames and poses need one clock"},
        Times{0, 4, 9'002, "b.csv: lasts 36004 s; at most 36000 s can be imported without poses"}));

TEST(ImportCsv, FindsTheOneGapAmongManyFrames) {
  const std::string text = "t,x,y,w,h\n0,9,9,2,2\n0.1,9,9,2,2\n0.2,9,9,2,2\n50000.3,9,9,2,2\n50000.4,9,9,2,2\n";
  EXPECT_NE(refusal(import_csv(text, "b.csv", settings())).find("a gap of 50000 s behind the time 0.200 s"),
            std::string::npos);
}

TEST(ImportCsv, NamesClocksOfBlobsAndPosesThatDiffer) {
  TakeSettings with_poses = settings();
  with_poses.poses = {{1.764e9, 0, 0, 0}, {1.764e9 + 1, 0, 0, 0}};
  EXPECT_NE(refusal(import_csv(table(0, 1, 3), "b.csv", with_poses)).find("frames and poses need one clock"),
            std::string::npos);
}

TEST(ImportCsv, DoubtsMillisecondsThatFitTheirPoses) {
  TakeSettings with_poses = settings();
  with_poses.poses = {{0, 0, 0, 0}, {100, 0, 0, 0}};
  const ImportResult result = import_csv(table(0, 33, 3), "b.csv", with_poses);
  ASSERT_TRUE(result.ok()) << refusal(result);
  ASSERT_EQ(result->summary.notes.size(), 1U);
  EXPECT_EQ(result->summary.notes[0], "times go up by 33 between rows: are they milliseconds? Seconds were read");
}

TEST(ImportCsv, StandsStillAtTheTimesOfAClockSince1970) {
  const Recorded log = recorded(import_csv(table(1'764e6, 1, 3), "b.csv", settings()));
  ASSERT_EQ(log.frames.size(), 3U);
  EXPECT_EQ(log.frames[0].t.raw, 1'000);
  EXPECT_EQ(log.frames[2].t.raw, 21'000);
  ASSERT_EQ(log.odometry.size(), 106U) << "2 s, and 0.1 s before them";
  EXPECT_EQ(log.odometry[1].t.raw, 200);
}

// Which of two columns is meant nobody can tell.
TEST(ImportCsv, RefusesTwoColumnsForOneThing) {
  const auto says = [](const char* header) {
    const ImportResult result = import_csv(std::string(header) + "\n1,2,3,4,5,6,7\n", "b.csv", settings());
    return result.ok() ? std::string() : result.error().message();
  };
  EXPECT_EQ(says("t,x,x,y,w,h,sig"),
            "b.csv:1: has columns \"x\" and \"x\" for one thing; rename the one that is not meant");
  EXPECT_EQ(says("time,T,x,y,w,h,sig"),
            "b.csv:1: has columns \"t\" and \"time\" for one thing; rename the one that is not meant");
  EXPECT_NE(says("t,x,y,x1,y1,x2,y2").find("\"x\" and \"x1\""), std::string::npos);
  EXPECT_EQ(says("t,x,y,w,h,,"), "") << "a spreadsheet's empty columns have no name";
}

TEST(ImportCsv, SaysWhenThereAreNoRows) {
  EXPECT_EQ(import_csv("t,x,y,w,h\n", "b.csv", settings()).error().message(),
            "b.csv: has names of columns and no rows; check that the copy is complete");
}

TEST(ImportCsv, SaysHowManyNamesThereAre) {
  std::string text = "t,x,y,w,h,name\n";
  for (int i = 0; i < 256; ++i) text += std::to_string(i) + ",50,50,9,9,colour " + std::to_string(i) + "\n";
  EXPECT_EQ(import_csv(text, "b.csv", settings()).error().what, "has 256 names of colours; there can be 255");
}

// As old Macs end their lines, and some terminals.
TEST(ImportCsv, ReadsLinesThatEndWithCrAlone) {
  EXPECT_EQ(recorded(import_csv("t,x,y,w,h\r1,50,50,9,9\r2,51,50,9,9\r", "b.csv", settings())).frames.size(), 2U);
}

TEST(ImportCsv, RefusesATumPoseThatTurnsNowhere) {
  EXPECT_THROW((void)parse_pose_table("0 1 2 0 0 0 0 0\n", "p.txt"), ImportError);
  EXPECT_EQ(parse_pose_table("0 1 2 0 0 0 0.71 0.71\n", "p.txt").size(), 1U) << "rounded";
}

TEST(ImportPlayer, ReadsPosesAndBlobsOfWritelog) {
  const std::string text =
      "## Player version 3.0.2\n## File version 0.3.0\n## Format:\n"
      "0000000010.000 16777343 6665 position2d 00 002 001 +0.000 +0.000 0.000 0.000 0.000\n"
      "0000000010.000 16777343 6665 position2d 00 001 001 +01.250 -00.500 +0.785 +00.200 +00.000 +0.000 0\n"
      "0000000010.000 16777343 6665 position2d 01 001 001 +09.000 -09.000 +0.785 +00.200 +00.000 +0.000 0\n"
      "0000000010.020 16777343 6665 laser 00 001 001 0 1 2 3\n"
      "garbage here\n\x01\x02\n"
      "0000000010.050 16777343 6665 blobfinder 00 001 001 0160 0120 0002 0000 16711680 0400 0080 0060 0070 0089 0050 "
      "0069 "
      "0000 0000 00065280 0025 0010 0010 0008 0012 0008 0012 0000\n"
      "0000000010.100 16777343 6665 position2d 00 001 001 +01.270 -00.500 +0.785 +00.200 +00.000 +0.000 0\n";
  const ImportResult result = import_player(text, "run.player", settings(160, 120));
  const Recorded log = recorded(result);
  ASSERT_EQ(log.odometry.size(), 2U);
  EXPECT_EQ(log.odometry[0].x.to_double(), 1.25);
  EXPECT_EQ(log.odometry[0].heading.to_double(), 0.785);
  ASSERT_EQ(log.frames.size(), 1U);
  ASSERT_EQ(log.frames[0].blobs.size(), 2U);
  expect_box(log.frames[0].blobs[0], 1, 70, 50, 89, 69);
  EXPECT_EQ(log.frames[0].blobs[0].rgb, (sensor::Rgb{255, 0, 0}));
  EXPECT_EQ(log.frames[0].blobs[0].pixels, 400U);
  EXPECT_EQ(log.frames[0].blobs[1].signature, 2) << "ids are all 0: by colour";
  EXPECT_EQ(skipped(result, "lines of no known form"), 2U);
  EXPECT_EQ(skipped(result, "poses of another position2d"), 1U);
}

TEST(ImportPlayer, NamesTheLineThatWasCutOffAndTheImageThatDoesNotFit) {
  const std::string blob = "10.0 1 6665 blobfinder 00 001 001 160 120 1 1 255 400 80 60 70 89 50 69";
  EXPECT_EQ(import_player("# x\n" + blob + "\n", "run.player", settings(160, 120)).error().where, "run.player:2");
  EXPECT_NE(import_player(blob + " 0\n", "run.player", settings(320, 240)).error().what.find("160 x 120"),
            std::string::npos);
}

can_wheels::Mapping mapping() {
  can_wheels::Mapping mapping;
  mapping.left = {.id = 0x201, .first_byte = 0, .size = 4};
  mapping.right = {.id = 0x202, .first_byte = 0, .size = 4};
  mapping.wheels.left_pm_per_count = mapping.wheels.right_pm_per_count = 1'000'000'000;  // 1 mm
  mapping.wheels.track_pm = 200'000'000'000;
  return mapping;
}

TEST(ImportCandump, TurnsFramesIntoPosesBesideATableOfBlobs) {
  // Both forms that candump has; the wheels go 10 counts of 1 mm in 0.1 s.
  std::string text = "(1436509052.000000) can0 201#00000000\n(1436509052.001000) can0 202#00000000\nnot a frame\n";
  for (int i = 1; i <= 10; ++i) {
    char line[160];
    const int n = 10 * i;
    std::snprintf(line, sizeof line,
                  "(1436509052.%d00000) can0 201#%02X000000\n (1436509052.%d01000)  can0  202   [4]  %02X 00 00 00\n",
                  i % 10, n, i % 10, n);
    if (i < 10) text += line;
  }
  text += "(1436509052.950000) can0 7FF#R\n(1436509052.96) can0 20\n";
  const Taken blobs = take_csv("t,x,y,w,h\n1436509052.4,100,100,20,20\n", "blobs.csv");
  const ImportResult result = import_candump(text, "can.log", mapping(), blobs, settings());
  const Recorded log = recorded(result);
  ASSERT_GE(log.odometry.size(), 8U);
  EXPECT_GE(log.odometry.back().t.raw, 7'900);
  EXPECT_NEAR(log.odometry.back().x.to_double(), 0.1 * log.odometry.back().t.to_double(), 2e-4);
  EXPECT_NEAR(log.odometry.back().y.to_double(), 0, 1e-4);
  ASSERT_EQ(log.frames.size(), 1U);
  EXPECT_EQ(skipped(result, "lines of no known form"), 2U);
  EXPECT_EQ(skipped(result, "CAN frames of other ids"), 1U);
}

TEST(ImportCandump, SaysWhichIdsToCompare) {
  const ImportResult result = import_candump("(1.0) can0 123#00\n", "can.log", mapping(), {}, settings());
  ASSERT_FALSE(result.ok());
  EXPECT_NE(result.error().remedy.find("compare the ids"), std::string::npos);
  EXPECT_NE(import_candump("hello\n", "can.log", mapping(), {}, settings()).error().remedy.find("candump -l"),
            std::string::npos);
}

/// Bytes of an MCAP file and of CDR, by the two specifications.
class Bytes {
 public:
  template <class Integer>
  Bytes& put(Integer value) {
    for (std::size_t i = 0; i < sizeof value; ++i)
      text += static_cast<char>((static_cast<std::uint64_t>(value) >> (8 * i)) & 0xFFU);
    return *this;
  }
  Bytes& string(const std::string& value) {
    put(static_cast<std::uint32_t>(value.size()));
    text += value;
    return *this;
  }
  /// CDR: aligned behind the header of four bytes.
  template <class Integer>
  Bytes& aligned(Integer value) {
    while ((text.size() - 4) % sizeof value != 0) text += '\0';
    return put(value);
  }
  Bytes& real(double value) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    return aligned(bits);
  }
  Bytes& cdr_string(const std::string& value) {
    aligned(static_cast<std::uint32_t>(value.size() + 1));
    text += value + '\0';
    return *this;
  }
  Bytes& header(double t) {
    const auto seconds = static_cast<std::uint32_t>(t);
    aligned(seconds);
    aligned(static_cast<std::uint32_t>(std::lround((t - seconds) * 1e9)));
    return cdr_string("base_link");
  }
  std::string text;
};

std::string mcap_record(std::uint8_t opcode, const std::string& content) {
  return Bytes().put(opcode).put(static_cast<std::uint64_t>(content.size())).text + content;
}
std::string message(std::uint16_t channel, const std::string& data) {
  return mcap_record(5,
                     Bytes().put(channel).put(0U).put(std::uint64_t{5'000'000'000}).put(std::uint64_t{0}).text + data);
}
std::string channel(std::uint16_t id, const std::string& schema, const std::string& topic,
                    const std::string& encoding) {
  return mcap_record(3, Bytes().put(id).string(schema).string("ros2msg").string("...").text) +
         mcap_record(4, Bytes().put(id).put(id).string(topic).string(encoding).put(0U).text);
}
Bytes cdr() {
  Bytes bytes;
  bytes.text = std::string("\0\1\0\0", 4);
  return bytes;
}
std::string odometry(double t, double x, double yaw) {
  Bytes bytes = cdr();
  bytes.header(t).cdr_string("odom");
  for (const double v : {x, 0.5, 0.0, 0.0, 0.0, std::sin(yaw / 2), std::cos(yaw / 2)}) bytes.real(v);
  for (int i = 0; i < 36 + 6 + 36; ++i) bytes.real(0);
  return bytes.text;
}
std::string detections(double t, const std::vector<std::string>& classes) {
  Bytes bytes = cdr();
  bytes.header(t).aligned(static_cast<std::uint32_t>(classes.size()));
  double x = 100;
  for (const std::string& name : classes) {
    bytes.header(t).aligned(2U);
    for (const auto& [id, score] : {std::pair<std::string, double>{"nothing", 0.1}, {name, 0.9}}) {
      bytes.cdr_string(id).real(score);
      for (int i = 0; i < 7 + 36; ++i) bytes.real(0);
    }
    for (const double v : {x, 60.0, 0.0, 20.0, 10.0}) bytes.real(v);
    bytes.cdr_string(name == "ball" ? "" : "track 7");
    x += 50;
  }
  return bytes.text;
}
const std::string kMagic("\x89MCAP0\r\n", 8);
std::string file_of(const std::string& records) {
  return kMagic + mcap_record(1, "") + records + mcap_record(15, std::string(4, '\0')) + kMagic;
}
std::string ros_records() {
  return channel(1, "vision_msgs/msg/Detection2DArray", "/boxes", "cdr") +
         channel(2, "nav_msgs/msg/Odometry", "/odom", "cdr") + channel(3, "std_msgs/msg/String", "/chatter", "cdr") +
         message(2, odometry(100, 1, 0.5)) + message(3, "noise") + mcap_record(0x77, "a record of the future") +
         message(1, detections(100.05, {"cone", "ball"})) + message(2, odometry(100.1, 1.1, 0.5)) +
         message(1, detections(100.15, {}));
}
std::string chunk(const std::string& compression, const std::string& packed, std::size_t size) {
  return mcap_record(6, std::string(16, '\0') +
                            Bytes()
                                .put(static_cast<std::uint64_t>(size))
                                .put(0U)
                                .string(compression)
                                .put(static_cast<std::uint64_t>(packed.size()))
                                .text +
                            packed);
}
void expect_ros(const ImportResult& result) {
  const Recorded log = recorded(result);
  ASSERT_EQ(log.frames.size(), 2U);
  ASSERT_EQ(log.frames[0].blobs.size(), 2U);
  expect_box(log.frames[0].blobs[0], 1, 90, 55, 109, 64);
  expect_box(log.frames[0].blobs[1], 2, 140, 55, 159, 64);
  EXPECT_EQ(log.frames[0].blobs[0].track, 1);
  EXPECT_EQ(log.frames[0].blobs[1].track, 0);
  ASSERT_EQ(log.signatures.size(), 2U);
  EXPECT_EQ(log.signatures[0].name.view(), "cone");
  EXPECT_EQ(log.frames[1].blobs.size(), 0U);
  ASSERT_EQ(log.odometry.size(), 2U);
  EXPECT_EQ(log.odometry[1].x.to_double(), 1.1);
  EXPECT_EQ(log.odometry[1].heading.to_double(), 0.5);
  EXPECT_EQ(log.frames[0].t.raw, 500);
}

TEST(ImportMcap, ReadsDetectionsAndOdometryWithAnyCompression) {
  const std::string records = ros_records();
  expect_ros(import_mcap(file_of(records), "run.mcap", {}, settings()));
  expect_ros(import_mcap(file_of(chunk("", records, records.size())), "run.mcap", {}, settings()));
  std::string lz4(LZ4F_compressFrameBound(records.size(), nullptr), '\0');
  lz4.resize(LZ4F_compressFrame(lz4.data(), lz4.size(), records.data(), records.size(), nullptr));
  expect_ros(import_mcap(file_of(chunk("lz4", lz4, records.size())), "run.mcap", {}, settings()));
  std::string zstd(ZSTD_compressBound(records.size()), '\0');
  zstd.resize(ZSTD_compress(zstd.data(), zstd.size(), records.data(), records.size(), 3));
  expect_ros(import_mcap(file_of(chunk("zstd", zstd, records.size())), "run.mcap", {}, settings()));
  ++zstd[zstd.size() / 2];
  EXPECT_FALSE(
      import_mcap(file_of(chunk("zstd", zstd.substr(0, zstd.size() / 2), records.size())), "run.mcap", {}, settings())
          .ok());
  const ImportResult other = import_mcap(file_of(chunk("brotli", "x", 1)), "run.mcap", {}, settings());
  ASSERT_FALSE(other.ok());
  EXPECT_EQ(other.error().what, "has chunks compressed by \"brotli\"");
}

std::string lz4_of(const std::string& bytes) {
  std::string packed(LZ4F_compressFrameBound(bytes.size(), nullptr), '\0');
  packed.resize(LZ4F_compressFrame(packed.data(), packed.size(), bytes.data(), bytes.size(), nullptr));
  return packed;
}

// Refused before there is memory for it, whether or not it would become so long.
TEST(ImportMcap, RefusesAChunkThatBecomesTooLarge) {
  const std::string records = ros_records();
  for (const std::size_t size : {std::size_t{70'000'000}, std::size_t{1} << 62U}) {
    const ImportResult result = import_mcap(file_of(chunk("lz4", lz4_of(records), size)), "run.mcap", {}, settings());
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().what, "has a chunk that becomes more than 64 MB");
  }
}

// A hundred thousand within each other would need more stack than there is.
TEST(ImportMcap, RefusesAChunkWithinAChunk) {
  std::string nested = ros_records();
  for (int i = 0; i < 2; ++i) nested = chunk("", nested, nested.size());
  EXPECT_EQ(import_mcap(file_of(nested), "run.mcap", {}, settings()).error().what, "has a chunk that is damaged");
}

TEST(ImportMcap, SaysWhatThereIsInstead) {
  const std::string others = channel(3, "std_msgs/msg/String", "/chatter", "cdr") + message(3, "noise");
  EXPECT_EQ(import_mcap(file_of(others), "run.mcap", {}, settings()).error().message(),
            "run.mcap: has 1 message, none of Detection2DArray or Odometry; it has \"/chatter\" of "
            "\"std_msgs/msg/String\"");
}

// Brackets, of which each takes eighty bytes.
TEST(ImportMcap, RefusesAJsonMessageThatIsTooLong) {
  const std::string records = channel(1, "vision_msgs/msg/Detection2DArray", "/boxes", "json");
  EXPECT_FALSE(
      import_mcap(file_of(records + message(1, std::string(1'100'000, '['))), "run.mcap", {}, settings()).ok());
}

TEST(ImportMcap, NamesTheGapBehindAMessageWithoutAStamp) {
  const std::string records = channel(1, "vision_msgs/msg/Detection2DArray", "/boxes", "cdr") +
                              message(1, detections(0, {"cone"})) + message(1, detections(1'764e6, {"cone"}));
  const ImportResult result = import_mcap(file_of(records), "run.mcap", {}, settings());
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().what, "has a gap of 1763999995 s behind the time 5.000 s")
      << "first by the time of its message";
}

TEST(ImportMcap, ReadsAFileThatWasCutOffAtAnyByte) {
  const std::string whole = file_of(ros_records());
  for (std::size_t size = 0; size < whole.size(); size += 7) {
    const ImportResult result = import_mcap(whole.substr(0, size), "run.mcap", {}, settings());
    if (result.ok() && size < whole.size() - 21) {
      EXPECT_NE(result->summary.notes.front().find("cut off"), std::string::npos) << size;
    }
  }
  EXPECT_FALSE(import_mcap("SQLite format 3", "run.db3", {}, settings()).ok());
}

// As texts, as numbers, empty, and not at all: numbered as they appear.
TEST(ImportMcap, NumbersTheIdsOfTracks) {
  const auto boxes = [](const std::string& seconds, const std::vector<std::string>& ids) {
    std::string list;
    for (const std::string& id : ids) {
      list += std::string(list.empty() ? "" : ",") + R"({"results":[],"bbox":{"center":{"x":)" +
              std::to_string(100 + 20 * std::count(list.begin(), list.end(), '[')) +
              R"(,"y":60},"size_x":10,"size_y":10})" + id + "}";
    }
    return R"({"header":{"stamp":{"sec":)" + seconds + R"(,"nanosec":0}},"detections":[)" + list + "]}";
  };
  const std::string records = channel(1, "vision_msgs/Detection2DArray", "/boxes", "json") +
                              message(1, boxes("100", {R"(,"id":"b4")", R"(,"id":"")", ""})) +
                              message(1, boxes("101", {R"(,"id":17)", R"(,"id":"b4")"}));
  const Recorded log = recorded(import_mcap(file_of(records), "run.mcap", {}, settings()));
  std::vector<int> ids;
  for (const auto& frame : log.frames) {
    for (const sensor::Blob& blob : frame.blobs) ids.push_back(blob.track);
  }
  EXPECT_EQ(ids, (std::vector<int>{1, 0, 0, 2, 1}));
}

TEST(ImportMcap, ReadsTheSameAsJson) {
  const std::string boxes =
      R"({"header":{"stamp":{"sec":100,"nanosec":50000000}},"detections":[{"results":[{"hypothesis":{"class_id":"cone","score":0.9}}],"bbox":{"center":{"position":{"x":100,"y":60},"theta":0},"size_x":20,"size_y":10}}]})";
  const std::string odom =
      R"({"header":{"stamp":{"sec":100,"nanosec":0}},"pose":{"pose":{"position":{"x":1,"y":0.5,"z":0},"orientation":{"x":0,"y":0,"z":0,"w":1}}}})";
  const std::string head =
      channel(1, "vision_msgs/Detection2DArray", "/boxes", "json") + channel(2, "nav_msgs/Odometry", "/odom", "json");
  const Recorded log =
      recorded(import_mcap(file_of(head + message(2, odom) + message(1, boxes)), "run.mcap", {}, settings()));
  ASSERT_EQ(log.frames.size(), 1U);
  expect_box(log.frames[0].blobs[0], 1, 90, 55, 109, 64);
  std::string middle = boxes;
  middle.replace(middle.find("\"size_x\":20"), 11, "\"size_x\":0");
  const Recorded bearing =
      recorded(import_mcap(file_of(head + message(2, odom) + message(1, middle)), "run.mcap", {}, settings()));
  ASSERT_EQ(bearing.frames[0].blobs.size(), 1U);
  EXPECT_TRUE(bearing.frames[0].blobs[0].bearing) << "no width";
  EXPECT_EQ(bearing.frames[0].blobs[0].cx.raw, 995);
  const ImportResult wrong = import_mcap(file_of(head + message(1, "{\"a\":1}")), "run.mcap", {}, settings());
  ASSERT_FALSE(wrong.ok());
  EXPECT_EQ(wrong.error().where, "run.mcap: message 1 of /boxes");
}

TEST(ImportMcap, RefusesALayoutThatItDoesNotKnow) {
  std::string old = detections(100, {"cone"}) + std::string(16, '\0');  // as of a version with more fields
  const ImportResult result =
      import_mcap(file_of(channel(1, "vision_msgs/msg/Detection2DArray", "/boxes", "cdr") + message(1, old)),
                  "run.mcap", {}, settings());
  ASSERT_FALSE(result.ok());
  EXPECT_NE(result.error().what.find("is not laid out as"), std::string::npos);
}

}  // namespace
}  // namespace fencepost::host
