// `fencepost train`, and `run` with what it wrote.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/host/cli/run.hpp"

namespace fencepost::host {
namespace {

using namespace testing;

/// Grey of 64 by 48 px. Columns 16 to 31 of rows 12 to 35 are orange: Y 126, U 72, V 185 in limited range.
std::string film(int pictures) {
  std::string bytes = "YUV4MPEG2 W64 H48 F20:1 C420jpeg\n";
  const auto plane = [&bytes](int scale, char rest, char orange) {
    for (int v = 0; v < 48; v += scale) {
      for (int u = 0; u < 64; u += scale) bytes += u >= 16 && u < 32 && v >= 12 && v < 36 ? orange : rest;
    }
  };
  for (int i = 0; i < pictures; ++i) {
    bytes += "FRAME\n";
    plane(1, 120, 126);
    plane(2, static_cast<char>(128), 72);
    plane(2, static_cast<char>(128), static_cast<char>(185));
  }
  return bytes;
}

class Train : public ::testing::Test {
 protected:
  Train() { spill(folder_.path() / "film.y4m", film(30)); }
  Outcome train(const std::string& arguments) const { return shell(folder_, "fencepost train " + arguments); }
  void refuses(const std::string& arguments, int exit_code, const std::string& message) const {
    const Outcome outcome = train(arguments);
    EXPECT_EQ(outcome.exit_code, exit_code) << arguments << "\n" << outcome.err;
    EXPECT_TRUE(holds(outcome.err, message));
  }
  Folder folder_;
};

TEST_F(Train, WritesTheColoursOfBoxes) {
  const Outcome outcome = train("film.y4m --box 18,14,10,8=orange --box 18,24,10,8=orange --box 40,10,8,8");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto file = nlohmann::json::parse(outcome.out);
  ASSERT_EQ(file["signatures"].size(), 2U);
  EXPECT_EQ(file["signatures"][0]["id"], 1);
  EXPECT_EQ(file["signatures"][0]["name"], "orange");
  EXPECT_EQ(file["signatures"][1]["name"], "colour 2");
  ASSERT_EQ(file["colours"].size(), 2U);
  // The colour's shares by these Y, U and V: 219, 103 and 15 of 337.
  EXPECT_LT(file["colours"][0]["red"][0], 0.64);
  EXPECT_GT(file["colours"][0]["red"][1], 0.65);
  EXPECT_TRUE(holds(outcome.err, "orange: 100 % of its boxes, 0 px elsewhere"));
}

TEST_F(Train, RunFindsWhatItLearned) {
  const Outcome outcome = shell(folder_,
                                "fencepost train film.y4m --box 18,14,10,8=orange -o colours.json && "
                                "fencepost run --camera video:film.y4m --odometry console --colours colours.json "
                                "--mode log --seconds 1");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(holds(outcome.out, "$FPSIG,1,"));
  EXPECT_TRUE(holds(outcome.out, ",video,ok"));
  EXPECT_TRUE(holds(outcome.out, "$FPFRM,"));
  EXPECT_TRUE(holds(outcome.out, ",1,16,12,31,35,"));
}

TEST_F(Train, KeepsThePicture) {
  ASSERT_EQ(train("film.y4m --save view.jpg").exit_code, 0);
  const Outcome again = train("view.jpg --box 18,14,10,8=orange");
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_TRUE(holds(again.err, "0 px elsewhere"));
}

TEST_F(Train, ReadsBoxesFromAFile) {
  spill(folder_.path() / "boxes", "# the red one\n18,14,10,8=orange\r\n\n40,10,8,8=grey\n");
  const auto file = nlohmann::json::parse(train("film.y4m --boxes boxes").out);
  EXPECT_EQ(file["signatures"].size(), 2U);
  EXPECT_EQ(file["signatures"][1]["name"], "grey");
}

TEST_F(Train, SaysWhatIsWrong) {
  refuses("film.y4m", 2, "no --box is given; write X,Y,WIDTH,HEIGHT");
  refuses("film.y4m --box 1,2,3", 2, "\"1,2,3\" is no box");
  refuses("film.y4m --box 1,2,3,4,5", 2, "is no box");
  refuses("film.y4m --box 1,2,3,x=red", 2, "is no box");
  refuses("film.y4m --box 60,10,8,8", 2, "is not in the picture, which has 64 x 48 px");
  refuses("film.y4m --box 2147483647,10,8,8", 2, "is not in the picture");
  refuses("none.jpg --box 1,1,4,4", 3, "none.jpg cannot be read");
  refuses("v4l2:/dev/video250 --box 1,1,4,4", 4, "cannot open the camera /dev/video250");
  refuses("v4l2:film.y4m --box 1,1,4,4", 2, "is no place for it");
}

TEST_F(Train, ColoursThatAreNoneAreRefused) {
  spill(folder_.path() / "robot.json", "{}");
  EXPECT_TRUE(ends(shell(folder_, "fencepost run --camera video:film.y4m --odometry console --colours robot.json"), 3,
                   "robot.json: has no \"colours\"; 'fencepost train' writes such a file"));
  EXPECT_TRUE(
      ends(shell(folder_, "fencepost run --camera video:film.y4m --odometry console"), 2, "no colour is trained"));
}

}  // namespace
}  // namespace fencepost::host
