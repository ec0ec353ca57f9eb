#include "tests/studies/hazards/reached.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

namespace fencepost::test {
namespace {

const Reached kBefore{"movers", "leader, 0.54 m ahead", 400, 356, 6000, 20};

std::string file_of(const std::string& text) {
  const std::string path = testing::TempDir() + "fencepost_reached.csv";
  std::ofstream(path) << text;
  return path;
}

TEST(Reached, IsReadAsItWasWritten) {
  const auto all = read_reached(file_of(reached_head() + "\n" + as_line(kBefore) + "\n"));
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(as_line(all[0]), as_line(kBefore));
  EXPECT_NE(find(all, {"movers", "leader, 0.54 m ahead"}), nullptr);
  EXPECT_EQ(find(all, {"walls", "leader, 0.54 m ahead"}), nullptr);
}

TEST(Reached, NamesTheLineThatItCannotRead) {
  for (const char* row : {"movers;leader;400", "movers;leader;400;401;1;0", "", "movers;leader;x;356;6000;20"}) {
    try {
      read_reached(file_of(reached_head() + "\n" + as_line(kBefore) + "\n" + row + "\n"));
      ADD_FAILURE() << row;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find("reached.csv:3: "), std::string::npos) << error.what();
    }
  }
  EXPECT_THROW(read_reached("/nowhere/reached.csv"), std::runtime_error);
}

// Of 400 runs each, the difference of two such shares has an error of 2.4 %.
TEST(Reached, IsWorseByMoreThanChanceAlone) {
  Reached now = kBefore;
  EXPECT_EQ(worse(kBefore, now), "");
  now.kept = 332;  // 83 %
  EXPECT_EQ(worse(kBefore, now), "");
  now.kept = 320;
  EXPECT_EQ(worse(kBefore, now), "80.0 % kept, 89.0 % before");
  now.kept = 400;
  EXPECT_EQ(worse(kBefore, now), "");
  now.false_stops = 36;
  EXPECT_EQ(worse(kBefore, now), "");
  now.false_stops = 60;
  EXPECT_EQ(worse(kBefore, now), "6.00 false stops in 10 min, 2.00 before");
}

TEST(Reached, ACellThatNeverMissedIsWorseAtTheFirstMiss) {
  Reached never = kBefore;
  never.kept = never.asked;
  Reached now = never;
  now.kept = 380;
  EXPECT_NE(worse(never, now), "");
}

}  // namespace
}  // namespace fencepost::test
