#include "hal/base/stamp.hpp"

#include <gtest/gtest.h>

namespace fencepost::test {
namespace {

using base::Stamp;
using base::Time;

TEST(Stamp, TellsHowLongAgo) {
  EXPECT_EQ(Stamp(Time{1000}).since(Time{1250}).raw, 250);
  EXPECT_EQ(Stamp(Time{1000}).since(Time{1000}).raw, 0);
  EXPECT_EQ(Stamp(Time{1000}).since(Time{900}).raw, -100);  // frames are handled after later odometry
}

TEST(Stamp, SurvivesTheWrapOfItsWord) {
  const Time before{0xFFFFFFFFLL - 5};
  EXPECT_EQ(Stamp(before).since(Time{before.raw + 20}).raw, 20);
  EXPECT_EQ(Stamp(Time{before.raw + 20}).since(before).raw, -20);
  EXPECT_GT(Stamp(Time{0}).since(Time{4'000'000'000}).raw, 3'900'000'000);  // 4.6 days are not the past
}

}  // namespace
}  // namespace fencepost::test
