// The map on a screen: a robot drives towards a red post, its picture is taken meanwhile.
#include "firmware/view/map_view.hpp"

#include <gtest/gtest.h>

#include "firmware/config/profile.hpp"
#include "tests/firmware/loop/desk.hpp"
#include "tests/firmware/view/painted.hpp"

namespace fencepost::test {
namespace {

using Profile = config::Small;

constexpr bus::Colour kRed{0xd0, 0x20, 0x20};
constexpr console::Links kWorking{sensor::LinkState::kOk, sensor::LinkState::kOk};

class MapViewTest : public ::testing::Test {
 protected:
  void drive(int turns) {
    for (int i = 0; i < turns; ++i) {
      desk.turn();
      map_view.turn(kWorking);
    }
  }
  void take_picture() {
    const int before = screen.pictures;
    for (int i = 0; i < 2000 && screen.pictures < before + 2; ++i) {
      map_view.turn(kWorking);
      screen.change_over();
    }
    ASSERT_EQ(screen.pictures, before + 2);
  }
  void press(const bus::Buttons& buttons) {
    map_view.press(buttons);
    map_view.press({});
  }
  std::size_t count(bus::Colour colour) const {
    std::size_t n = 0;
    for (std::size_t y = 0; y < 160; ++y) {
      for (std::size_t x = 0; x < 160; ++x) n += screen.at(x, y) == colour ? 1U : 0U;
    }
    return n;
  }

  Desk<Profile> desk{console::Mode::kText, desk_approach(500)};
  FakeScreen screen;
  view::MapView<loop::Pipeline<Profile>, FakeScreen> map_view{desk.pipeline(), screen};
};

TEST_F(MapViewTest, ShowsAnEmptyMapBeforeAnythingIsKnown) {
  map_view.start();
  take_picture();
  EXPECT_EQ(count(kRed), 0U);
  EXPECT_EQ(screen.at(162, 3), view::kFixedColours[view::kLevels]);  // clear
}

// The post is 0.1 m wide with its front a metre ahead, the robot at (0.4, 0). At 20 mm a pixel, the robot in the
// middle: the post's middle is 0.65 m ahead, 32 pixels up.
TEST_F(MapViewTest, ShowsThePostWhereItStands) {
  map_view.start();
  drive(10'000);
  for (int i = 0; i < 7; ++i) {
    press({.a = true});
    take_picture();
  }
  for (int i = 0; i < 3; ++i) {
    press({.b = true});
    take_picture();
  }
  const std::size_t radius = 3;
  EXPECT_EQ(screen.at(80, 80), view::kFixedColours[view::kRobot]);
  EXPECT_EQ(screen.at(80, 80 - 32), kRed);
  EXPECT_NE(screen.at(80, 80 - 32 - 2 * radius - 3), kRed);
  EXPECT_NE(screen.at(80 - 2 * radius - 3, 80 - 32), kRed);
  EXPECT_NE(screen.at(162, 3), view::kFixedColours[view::kLevels]);  // something is near
  EXPECT_EQ(screen.at(163, 58), kRed);                               // in the list
}

TEST_F(MapViewTest, NearerMakesThePostLargerAndSelectForgetsIt) {
  map_view.start();
  drive(10'000);
  for (int i = 0; i < 3; ++i) {
    take_picture();
    press({.b = true});
  }
  take_picture();
  const std::size_t before = count(kRed);
  EXPECT_GT(before, 0U);
  press({.a = true});
  take_picture();
  EXPECT_GT(count(kRed), before);
  press({.select = true});
  take_picture();
  EXPECT_EQ(count(kRed), 0U);
  EXPECT_EQ(desk.memory().map.size(), 0U);
}

TEST_F(MapViewTest, StartGoesThroughTheModesOnceAPress) {
  const auto mode = [this] { return desk.pipeline().mode(); };
  map_view.press({.start = true});
  map_view.press({.start = true});
  EXPECT_EQ(mode(), console::Mode::kLog);
  map_view.press({});
  for (const console::Mode next : {console::Mode::kPlot, console::Mode::kQuiet, console::Mode::kText}) {
    press({.start = true});
    EXPECT_EQ(mode(), next);
  }
}

TEST_F(MapViewTest, ATurnPaintsNoMoreThanTwoRowsAndWaitsForTheScreen) {
  screen.slow = true;
  for (int i = 0; i < 1000; ++i) {
    const int before = screen.rows_put;
    map_view.turn(kWorking);
    EXPECT_LE(screen.rows_put - before, 2);
  }
  EXPECT_EQ(screen.pictures, 1);
  EXPECT_EQ(screen.rows_put, 160);
  screen.change_over();
  take_picture();
}

}  // namespace
}  // namespace fencepost::test
