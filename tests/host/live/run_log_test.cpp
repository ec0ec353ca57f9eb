#include "host/live/run_log.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/host/live/log_folder.hpp"

namespace fencepost::host {
namespace {

TEST(CalibrationLines, KnowWhatIsInForce) {
  CalibrationLines lines;
  EXPECT_EQ(lines.in_force(), "");
  lines.note("$FPCFG,alert.stop,0.25*0000\r\n");
  lines.note("$FPSIG,12,ffff00,lemon*0000\r\n");
  lines.note("$FPSIG,3,d02020,red*0000\r\n");
  lines.note("$FPCAM,pixy2,316*0000\r\n");
  lines.note("$FPODO,1,2,3,4*0000\r\n");
  EXPECT_EQ(lines.in_force(),
            "$FPCAM,pixy2,316*0000\r\n$FPSIG,3,d02020,red*0000\r\n$FPSIG,12,ffff00,lemon*0000\r\n"
            "$FPCFG,alert.stop,0.25*0000\r\n");
  lines.note("$FPSIG,3,0000ff,blue*0000\r\n");
  lines.note("$FPCFG,alert.stop,0.30*0000\r\n");
  EXPECT_NE(lines.in_force().find("blue"), std::string::npos);
  EXPECT_EQ(lines.in_force().find("red"), std::string::npos);
  EXPECT_EQ(lines.in_force().find("0.25"), std::string::npos);
  lines.note("$FPHDR,1,fencepost,0.1.0,linux,full*0000\r\n");
  EXPECT_EQ(lines.in_force(), "");
}

using RunLogTest = LogFolder;

RunLog opened(const RunLogSettings& settings) {
  linux::Opened<RunLog> log = RunLog::open(settings, at(0));
  EXPECT_TRUE(log) << log.problem();
  return std::move(*log);
}

/// The writes of this process, as the kernel counts them.
int writes_so_far() {
  std::ifstream counts("/proc/self/io");
  for (std::string word; counts >> word;) {
    if (word == "syscw:" && counts >> word) return std::stoi(word);
  }
  return -1;
}

// Some disks take more than a second for each write: 19 lines of a calibration were 19 of them.
TEST_F(RunLogTest, APortionIsOneWriteWhereThereAreNoParts) {
  if (writes_so_far() < 0) GTEST_SKIP() << "this kernel does not count";
  RunLog log = opened({path, false, 0, {}, "small"});
  std::string lines;
  for (int i = 0; i < 19; ++i) lines += "$FPCFG,alert.stop,0." + std::to_string(i) + "*0000\r\n";
  const int before = writes_so_far();
  ASSERT_FALSE(log.write(lines, at(1)));
  EXPECT_EQ(writes_so_far() - before, 1);
  EXPECT_EQ(contents(path), lines);
}

// A part of 400 bytes ends with the line that makes it this long: the long one. The next part begins with what was in
// force then, not with what came later.
TEST_F(RunLogTest, ALaterPartBeginsWithWhatWasInForceThere) {
  RunLog log = opened({path, false, 400, {}, "small"});
  const std::string head = "$FPHDR,1,fencepost*0000\r\n";
  const std::string camera = "$FPCAM,one*0000\r\n";
  const std::string input = "$FPODO,1,2,3,4*0000\r\n";
  const std::string other = "$FPCAM,two*0000\r\n";
  const std::string long_line = "# " + std::string(400, 'x') + "\r\n";
  for (const std::string& line : {head, camera, long_line, input, other}) ASSERT_FALSE(log.write(line, at(1)));
  EXPECT_EQ(log.name(), path + " to " + folder.file("run-0002.log"));
  ASSERT_FALSE(log.close());
  EXPECT_EQ(contents(path), head + camera + long_line);
  EXPECT_EQ(contents(folder.file("run-0002.log")),
            "# the run goes on that began in " + path + ", profile small\r\n" + camera + input + other);
}

// Lines come in portions; where a part ends within one does not change what it holds.
TEST_F(RunLogTest, PortionsOfLinesGiveTheSameParts) {
  std::string text = "$FPHDR,1,fencepost*0000\r\n";
  for (int i = 0; i < 60; ++i) {
    text += "$FPODO,1,2,3,4*0000\r\n";
    if (i % 7 == 0) text += "$FPCFG,alert.stop,0." + std::to_string(i) + "*0000\r\n";
  }
  const auto parts_of = [&](std::size_t lines_at_once) {
    const test::Folder own;
    std::string all;
    {
      RunLog log = opened({own.file("x.log"), false, 200, {}, "small"});
      for (std::size_t begin = 0; begin < text.size();) {
        std::size_t end = begin;
        for (std::size_t i = 0; i < lines_at_once && end < text.size(); ++i) end = text.find('\n', end) + 1;
        EXPECT_FALSE(log.write(std::string_view(text).substr(begin, end - begin), at(1)));
        begin = end;
      }
    }
    for (unsigned part = 1; part <= 20; ++part) all += "|" + contents(part_path(own.file("x.log"), part));
    for (std::size_t i = 0; (i = all.find(own.file("x.log"), i)) != std::string::npos;)
      all.erase(i, own.file("x.log").size());
    return all;
  };
  const std::string by_lines = parts_of(1);
  EXPECT_NE(by_lines.find("||"), std::string::npos) << "fewer than twenty parts";
  EXPECT_EQ(parts_of(3), by_lines);
  EXPECT_EQ(parts_of(1000), by_lines);
}

TEST_F(RunLogTest, AnAgedPartEndsToo) {
  RunLog log = opened({path, false, 0, base::Duration::nearest(60), "full"});
  ASSERT_FALSE(log.write("a\n", at(1)));
  ASSERT_FALSE(log.write("b\n", at(59.9)));
  EXPECT_EQ(log.name(), path);
  ASSERT_FALSE(log.write("c\n", at(60)));
  ASSERT_FALSE(log.write("d\n", at(61)));
  EXPECT_EQ(contents(path) + contents(folder.file("run-0002.log")),
            "a\nb\n# the run goes on that began in " + path + ", profile full\r\nc\nd\n");
}

TEST_F(RunLogTest, AFileThatIsThereStays) {
  spill(path, "precious");
  const linux::Opened<RunLog> log = RunLog::open({path, false, 0, {}, "full"}, at(0));
  ASSERT_FALSE(log.ok());
  EXPECT_NE(log.problem().find("--force"), std::string::npos) << log.problem();
  EXPECT_EQ(contents(path), "precious");
  EXPECT_EQ(opened({path, true, 0, {}, "full"}).bytes(), 0U);
  EXPECT_EQ(contents(path), "");
}

}  // namespace
}  // namespace fencepost::host
