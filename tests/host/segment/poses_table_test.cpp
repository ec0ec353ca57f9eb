#include "host/segment/poses_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "host/segment/image_file.hpp"

namespace fencepost::host {
namespace {

TEST(PosesTable, IsReadByColumnNames) {
  const PosesTable table = parse_poses("image,t,x,y,heading\na.png,0,1,2,3\nb.png,0.5,-1.25,2e-1,-3\n", "poses.csv");
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(table.rows[1].image, "b.png");
  EXPECT_EQ(table.rows[1].pose.t, 0.5);
  EXPECT_EQ(table.rows[1].pose.x, -1.25);
  EXPECT_EQ(table.rows[1].pose.y, 0.2);
  EXPECT_EQ(table.rows[1].pose.heading, -3);
  EXPECT_EQ(table.place(table.rows[1]), "poses.csv:3");
  EXPECT_FALSE(table.made_up_times);
  EXPECT_FALSE(table.shifted_times);
}

TEST(PosesTable, TakesWhatSpreadsheetsWrite) {
  const PosesTable table = parse_poses(
      "\xef\xbb\xbfheading, z ,y,x,image\r\n# by hand\r\n\r\n 3 ,9, 2,1 , my view.png \r\n4,9,2,1,b.png", "p");
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(table.rows[0].image, "my view.png");
  EXPECT_EQ(table.rows[0].pose.x, 1);
  EXPECT_EQ(table.rows[0].pose.y, 2);
  EXPECT_EQ(table.rows[0].pose.heading, 3);
  EXPECT_EQ(table.rows[1].line, 5U);
  EXPECT_EQ(table.unused_columns, std::vector<std::string>{"\"z\""});
}

TEST(PosesTable, MakesUpTimesWhereThereAreNone) {
  const PosesTable table = parse_poses("image,x,y,heading\na,0,0,0\nb,0,0,0\nc,0,0,0\n", "p");
  EXPECT_TRUE(table.made_up_times);
  EXPECT_DOUBLE_EQ(table.rows[2].pose.t, 0.2);
}

TEST(PosesTable, CountsClockTimesFromTheFirst) {
  const PosesTable table = parse_poses("image,t,x,y,heading\na,1732197600.25,0,0,0\nb,1732197601.5,0,0,0\n", "p");
  EXPECT_TRUE(table.shifted_times);
  EXPECT_EQ(table.rows[0].pose.t, 0);
  EXPECT_DOUBLE_EQ(table.rows[1].pose.t, 1.25);
  const PosesTable early = parse_poses("image,t,x,y,heading\na,-1,0,0,0\nb,1,0,0,0\n", "p");
  EXPECT_TRUE(early.shifted_times);
  EXPECT_EQ(early.rows[1].pose.t, 2);
}

TEST(PosesTable, ATickApartIsApart) {
  EXPECT_EQ(parse_poses("image,t,x,y,heading\na,0.3,0,0,0\nb,0.3001,0,0,0\n", "p").rows.size(), 2U);
}

struct Bad {
  const char* text;
  const char* says;
};

class BadTable : public ::testing::TestWithParam<Bad> {};

TEST_P(BadTable, SaysWhereAndWhat) {
  try {
    (void)parse_poses(GetParam().text, "p");
    FAIL() << "was accepted";
  } catch (const SegmentProblem& problem) {
    EXPECT_EQ(problem.message().rfind(GetParam().says, 0), 0U) << problem.message();
    EXPECT_FALSE(problem.remedy.empty());
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, BadTable,
    ::testing::Values(
        Bad{"", "p: is empty"}, Bad{"\n# only a remark\n", "p: is empty"},
        Bad{"image,t,x,y,heading\n", "p: has a header but no rows"},
        Bad{"a.png,0,0,0,0\n", "p:1: has no column \"image\""},
        Bad{"image,x,y\na,0,0\n", "p:1: has no column \"heading\""},
        Bad{"image,x,y,heading,x\na,0,0,0,0\n", "p:1: has two columns \"x\""},
        Bad{"image,x,y,heading\na,0,0\n", "p:2: has 3 columns instead of 4"},
        Bad{"image,x,y,heading\na,b,0,0,0\n", "p:2: has 5 columns instead of 4"},
        Bad{"image,x,y,heading\n,0,0,0\n", "p:2: names no image"},
        Bad{"image,x,y,heading\n\na,zero,0,0\n", "p:3: x is \"zero\", not a number"},
        Bad{"image,x,y,heading\na,,0,0\n", "p:2: x is \"\", not a number"},
        Bad{"image,x,y,heading\na,0,nan,0\n", "p:2: y is \"nan\", not a number"},
        Bad{"image,x,y,heading\na,0,inf,0\n", "p:2: y is \"inf\", not a number"},
        Bad{"image,x,y,heading\na,0,1e999,0\n", "p:2: y is \"1e999\", not a number"},
        Bad{"image,x,y,heading\na,0,0,1 2\n", "p:2: heading is \"1 2\", not a number"},
        Bad{"image,x,y,heading\na,1000.5,0,0\n", "p:2: x is beyond +-1000"},
        Bad{"image,x,y,heading\na,0,0,-1001\n", "p:2: heading is beyond +-1000"},
        Bad{"image,x,y,heading\na,0,0,0\na,1,0,0\n", "p:3: \"a\" is there twice"},
        Bad{"image,t,x,y,heading\na,1,0,0,0\nb,1,0,0,0\n", "p:3: t is not later than the line before"},
        Bad{"image,t,x,y,heading\na,2,0,0,0\nb,1,0,0,0\n", "p:3: t is not later than the line before"},
        Bad{"image,t,x,y,heading\na,1e18,0,0,0\nb,1,0,0,0\n", "p:3: t is not later than the line before"},
        Bad{"image,t,x,y,heading\na,1e-300,0,0,0\nb,2e-300,0,0,0\n", "p:3: t is not later than the line before"},
        Bad{"image,t,x,y,heading\na,0,0,0,0\nb,1e6,0,0,0\n", "p:3: t is more than 999999 s after the first"}));

// Hostile files: pieces of tables, mixed and damaged at random. Each is refused with a place, or read to poses that the
// stream can hold.
TEST(PosesTable, HostileTablesAreRefusedOrSound) {
  const std::vector<std::string> pieces = {"image",
                                           "t",
                                           "x",
                                           "y",
                                           "heading",
                                           ",",
                                           "\n",
                                           "\r\n",
                                           "a.png",
                                           "0",
                                           "1.5",
                                           "-3",
                                           "1e9",
                                           "1e18",
                                           "nan",
                                           "-1e308",
                                           "\"",
                                           "#",
                                           "\xff",
                                           " ",
                                           "image,t,x,y,heading\n",
                                           "image,x,y,heading\n",
                                           "b,0,0,0\n",
                                           "c,1,2,3,4\n",
                                           std::string(1, '\0'),
                                           std::string(5000, '9')};
  std::mt19937 random(20260101);
  int accepted = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::string text = i % 2 == 0 ? "image,t,x,y,heading\na,0,0,0,0\nb,1,0,0,0\n" : "";
    for (auto k = random() % 12; k > 0; --k) {
      if (random() % 3 == 0 && !text.empty()) {
        text[random() % text.size()] = static_cast<char>(random() % 256);
      } else {
        text.insert(random() % (text.size() + 1), pieces[random() % pieces.size()]);
      }
    }
    try {
      const PosesTable table = parse_poses(text, "p");
      ++accepted;
      double last = -1;
      for (const ImagePose& row : table.rows) {
        ASSERT_FALSE(row.image.empty());
        for (const double value : {row.pose.x, row.pose.y, row.pose.heading}) ASSERT_LE(std::abs(value), 1000);
        ASSERT_GE(row.pose.t, 0);
        ASSERT_LE(row.pose.t, 999'999);
        const double tick = std::round(row.pose.t * 1e4);
        ASSERT_GT(tick, last);
        last = tick;
      }
    } catch (const SegmentProblem& problem) {
      ASSERT_EQ(problem.where.rfind("p", 0), 0U);
      for (const char c : problem.message()) ASSERT_TRUE(c >= ' ' && c <= '~') << "a message is printable";
      ASSERT_LT(problem.message().size(), 300U);
    }
  }
  EXPECT_GT(accepted, 500) << "the pieces must also make tables that are read";
}

}  // namespace
}  // namespace fencepost::host
