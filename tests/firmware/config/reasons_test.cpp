// The reasons why a choice of devices or a car's record is refused, and the bounds of a colour's window.
#include <gtest/gtest.h>

#include <set>
#include <string_view>

#include "firmware/config/car.hpp"
#include "firmware/config/colours.hpp"
#include "firmware/config/devices.hpp"

namespace fencepost::config {
namespace {

TEST(Refusals, EachSaysSomethingOfItsOwn) {
  EXPECT_EQ(reason(Refusal::kNone), "");
  EXPECT_EQ(reason(Refusal::kCameraNotInImage), "the image of this board does not contain that camera");
  EXPECT_EQ(reason(Refusal::kOdometryNotInImage), "the image of this board does not contain that odometry");
  std::set<std::string_view> all;
  constexpr int kLast = static_cast<int>(Refusal::kNoMotors);
  for (int i = 0; i <= kLast; ++i) EXPECT_TRUE(all.insert(reason(static_cast<Refusal>(i))).second) << i;
  EXPECT_EQ(reason(static_cast<Refusal>(kLast + 1)), "") << "of a newer one";
}

TEST(Refusals, OfACarSayWhatToTell) {
  using odometry::CarProblem;
  EXPECT_EQ(reason(CarProblem::kNone), "");
  EXPECT_NE(reason(CarProblem::kNoCounts).find("'set car.counts'"), std::string_view::npos);
  EXPECT_NE(reason(CarProblem::kNoHeading).find("yaw rate"), std::string_view::npos);
  EXPECT_NE(reason(CarProblem::kNoWheelbase).find("'set car.wheelbase'"), std::string_view::npos);
  EXPECT_EQ(reason(static_cast<CarProblem>(4)), "");
}

// A result document of a newer program may name a camera that this one does not know.
TEST(Calibration, ACameraThatIsNotKnownHasNone) {
  EXPECT_EQ(delivered_calibration(static_cast<CameraId>(kCameraIds)), sensor::CameraIntrinsics{});
}

TEST(Colours, AWindowIsFortyToEitherSideWithinAByte) {
  const cmucam::ColourWindow middle = window_around({3, {100, 40, 215}, "name"});
  EXPECT_EQ(middle.signature, 3);
  EXPECT_EQ(middle.red_min, 60);
  EXPECT_EQ(middle.red_max, 140);
  EXPECT_EQ(middle.green_min, 0);
  EXPECT_EQ(middle.green_max, 80);
  EXPECT_EQ(middle.blue_min, 175);
  EXPECT_EQ(middle.blue_max, 255);
  const cmucam::ColourWindow edge = window_around({4, {39, 0, 255}, "name"});
  EXPECT_EQ(edge.red_min, 0);
  EXPECT_EQ(edge.red_max, 79);
  EXPECT_EQ(edge.green_min, 0);
  EXPECT_EQ(edge.green_max, 40);
  EXPECT_EQ(edge.blue_min, 215);
  EXPECT_EQ(edge.blue_max, 255);
}

}  // namespace
}  // namespace fencepost::config
