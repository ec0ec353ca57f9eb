// Importers as their users call them, and packed files.
#include <gtest/gtest.h>

#include "firmware/record/encode.hpp"
#include "tests/host/cli/run.hpp"
#include "tests/host/simulate/recorded.hpp"

namespace fencepost::host {
namespace {

using namespace testing;

TEST(ImportCommand, ASketchWithPosesBecomesAMap) {
  std::string monitor;
  std::string poses = "t,x,y,heading\n";
  for (int i = 0; i < 20; ++i) {  // past a pillar of 6 cm, 1.2 m ahead and 0.3 m to the left
    char line[200];
    const double ahead = 1.2 - 0.03 * i;
    std::snprintf(
        line, sizeof line,
        "12:00:%02d.%03d -> Detected 1\n12:00:%02d.%03d ->   block 0: sig: 1 x: %.0f y: 90 width: %.0f height: "
        "40 index: 1 age: %d\nrubbish\n",
        i / 10, 100 * (i % 10), i / 10, 100 * (i % 10), 157.5 - 273.7 * 0.3 / ahead, 273.7 * 0.06 / ahead, i);
    monitor += line;
    std::snprintf(line, sizeof line, "%.2f,%.3f,0,0\n", 43'200 + 0.1 * i, 0.03 * i);
    poses += line;
  }
  spill("monitor.txt", monitor);
  spill("poses.csv", poses);
  const Outcome run = shell("fencepost import sketch monitor.txt --camera pixy2 --poses poses.csv -o run.log");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "20 frames with 20 blobs, 20 odometry samples\nleft out: lines of no known form (20)\n");
  const Outcome map = shell("fencepost replay run.log");
  EXPECT_EQ(map.exit_code, 0) << map.err;
  EXPECT_TRUE(holds(map.out, "signature1 confirmed"));
}

TEST(ImportCommand, OneOfAThingIsNamedAsOne) {
  spill("monitor.txt",
        "12:00:00.000 -> Detected 1\n"
        "12:00:00.000 ->   block 0: sig: 1 x: 89 y: 90 width: 14 height: 40 index: 1 age: 0\nrubbish\n");
  spill("poses.csv", "t,x,y,heading\n43200,0,0,0\n");
  const Outcome run = shell("fencepost import sketch monitor.txt --camera pixy2 --poses poses.csv -o run.log");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "1 frame with 1 blob, 1 odometry sample\nleft out: lines of no known form (1)\n");
}

template <class Record>
std::string line_of(const Record& record) {
  std::array<char, record::kMaxLine> line{};
  return {line.data(), record::encode(record, line)};
}

TEST(ImportCommand, WhatWasExportedToMcapComesBackWithTheIdsOfItsTracker) {
  sensor::CameraIntrinsics camera;
  camera.model = "test";
  camera.width = 316;
  camera.height = 208;
  camera.fx = camera.fy = base::Pixels2::nearest(270);
  sensor::Blob near{1, 100, 90, 119, 130, base::Pixels1::nearest(109.5), base::Pixels1::nearest(110), 0, {}};
  sensor::Blob far{1, 200, 90, 209, 110, base::Pixels1::nearest(204.5), base::Pixels1::nearest(100), 0, {}};
  near.track = 1;
  std::string log = line_of(camera);
  std::vector<sensor::BlobFrame> frames;
  for (std::int64_t t = 1'000; t < 9'000; t += 1'000) {
    if (t == 4'000) far.track = 2;
    log += line_of(sensor::OdometrySample{base::Time{t}, {}, {}, {}});
    frames.push_back({base::Time{t}, static_cast<std::uint32_t>(frames.size()), {}});
    for (const sensor::Blob& blob : {near, far}) ASSERT_TRUE(frames.back().blobs.push_back(blob));
    log += line_of(frames.back());
  }
  spill("run.log", log);
  for (const std::string format : {"mcap", "mcap-ros2"}) {
    const Outcome run = shell("fencepost export run.log --format " + format +
                              " -o run.mcap && "
                              "fencepost import mcap run.mcap --camera run.log");
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const Recorded back = read_back(run.out);
    ASSERT_EQ(back.frames.size(), frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i) EXPECT_EQ(back.frames[i].blobs, frames[i].blobs) << format << i;
  }
}

TEST(ImportCommand, SaysWhatIsMissing) {
  spill("b.csv", "t,x,y,w,h\n1,2,3,4,5\n");
  const Outcome blind = shell("fencepost import csv b.csv");
  EXPECT_EQ(blind.exit_code, 3);
  EXPECT_EQ(blind.out, "");
  EXPECT_EQ(
      blind.err,
      "fencepost: b.csv: does not say how its camera sees; give --camera: a name such as pixy2, or a file with its "
      "calibration\n");
  spill("robot.json", "{}");
  EXPECT_TRUE(ends(shell("fencepost import candump b.csv --robot robot.json --blobs b.csv --camera pixy2"), 3,
                   "has no \"can\""));
  EXPECT_EQ(shell("fencepost import mcap b.csv --camera pixy2").exit_code, 3);
  EXPECT_EQ(shell("fencepost import player b.csv --camera pixy2").exit_code, 3);
}

TEST(PackedInput, IsReadEverywhereAndRefusedWhereItIsDamaged) {
  ASSERT_EQ(shell("gzip -c " + recording("stop_pixy2.log") + " > run.log.gz").exit_code, 0);
  const Outcome whole = shell("fencepost replay " + recording("stop_pixy2.log"));
  const Outcome packed = shell("fencepost replay run.log.gz");
  EXPECT_EQ(packed.exit_code, 0) << packed.err;
  EXPECT_EQ(packed.out, whole.out);
  EXPECT_EQ(shell("fencepost replay - < run.log.gz").out, whole.out);
  // Two members behind each other, as `cat a.gz b.gz` makes them.
  ASSERT_EQ(shell("head -c 5000 " + recording("stop_pixy2.log") + " | gzip > two.gz; tail -c +5001 " +
                  recording("stop_pixy2.log") + " | gzip >> two.gz")
                .exit_code,
            0);
  EXPECT_EQ(shell("fencepost replay two.gz").out, whole.out);
  ASSERT_EQ(shell("head -c 3000 run.log.gz > cut.gz").exit_code, 0);
  EXPECT_TRUE(ends(shell("fencepost replay cut.gz"), 3, "damaged or cut off; try 'gzip -t'"));
}

// A few KB that become 70 MB, and a file whose size says enough: none of them is read to its end.
TEST(PackedInput, HasALimit) {
  ASSERT_EQ(shell("head -c 70000000 /dev/zero | gzip -1 > zeros.gz; truncate -s 3G huge").exit_code, 0);
  for (const char* line :
       {"import csv zeros.gz --camera pixy2", "simulate zeros.gz", "import csv huge --camera pixy2",
        "configure huge -o x.bin", "replay " FENCEPOST_RECORDINGS "/stop_pixy2.log --camera zeros.gz",
        "import mcap huge --camera pixy2"}) {
    const Outcome run = shell("ulimit -v 1000000; fencepost " + std::string(line));
    EXPECT_EQ(run.exit_code, 3) << line;
    EXPECT_TRUE(holds(run.err, " has more than ")) << line << ": " << run.err;
  }
}

// At once, not when most of it has been replayed.
TEST(Export, ALogThatIsTooLongForAHistoryIsRefusedBeforeItIsReplayed) {
  ASSERT_EQ(shell("yes '$FPODO,1,2,3,4*0000' | head -c 65000000 > long.log").exit_code, 0);
  for (const char* name : {"x.csv", "x.mcap"}) {
    EXPECT_TRUE(ends(shell("fencepost export long.log -o " + std::string(name)), 3, "has more than 64 MB"));
  }
}

}  // namespace
}  // namespace fencepost::host
