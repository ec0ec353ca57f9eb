// When a push button counts as pressed.
#include "firmware/loop/button.hpp"

#include <gtest/gtest.h>

namespace fencepost::loop {
namespace {

struct PushButton : ::testing::Test {
  Button button;
  int now = 0;  // ms
  /// Looked at each 5 ms: how often it was pressed.
  int hold(bool down, int milliseconds) {
    int presses = 0;
    for (const int end = now + milliseconds; now < end; now += 5)
      presses += button.pressed(down, base::Time{} + base::milliseconds(now)) ? 1 : 0;
    return presses;
  }
};

TEST_F(PushButton, CountsAPressOnce) {
  EXPECT_EQ(hold(false, 100), 0);
  EXPECT_EQ(hold(true, 1'000), 1);
  EXPECT_EQ(hold(false, 100), 0);
  EXPECT_EQ(hold(true, 100), 1);
}

TEST_F(PushButton, BouncesUnnoticed) {
  hold(false, 100);
  int presses = 0;
  for (int i = 0; i < 3; ++i) presses += hold(true, 5) + hold(false, 5);
  presses += hold(true, 100);
  for (int i = 0; i < 3; ++i) presses += hold(false, 5) + hold(true, 5);
  EXPECT_EQ(presses + hold(false, 100), 1);
}

TEST_F(PushButton, TakesAShortPulseForNoise) {
  hold(false, 100);
  EXPECT_EQ(hold(true, 15) + hold(false, 100), 0);
}

TEST_F(PushButton, IsNotPressedByBeingHeldFromTheBeginning) {
  EXPECT_EQ(hold(true, 1'000), 0);
  EXPECT_EQ(hold(false, 100) + hold(true, 100), 1);
}

}  // namespace
}  // namespace fencepost::loop
