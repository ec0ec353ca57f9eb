// Golden bytes of the protocols' descriptions, from the devices' side.
#include "host/emulate/models/can_wheels.hpp"

#include <gtest/gtest.h>

#include "tests/drivers/hex.hpp"

namespace fencepost::emulate {
namespace {

using test::bytes_of;
using test::hex;

TEST(EmulatedCanWheels, Canopen) {
  CanWheels wheels(CanWheels::Kind::kCanopen, base::Time{});
  wheels.turn(100'000, -123'456, 0, 0);
  EXPECT_TRUE(wheels.frames(base::Time{3'999}).empty());
  const auto left = wheels.frames(base::Time{4'000});
  ASSERT_EQ(left.size(), 1U);
  EXPECT_EQ(left[0].id, 0x185U);
  EXPECT_EQ(bytes_of(left[0].bytes()), hex("37 06 A0 86 01 00"));
  const auto right = wheels.frames(base::Time{4'070});
  ASSERT_EQ(right.size(), 1U);
  EXPECT_EQ(right[0].id, 0x186U);
  EXPECT_EQ(bytes_of(right[0].bytes()), hex("37 06 C0 1D FE FF"));
}

TEST(EmulatedCanWheels, TalonSrx) {
  CanWheels wheels(CanWheels::Kind::kTalonSrx, base::Time{});
  wheels.turn(123'456, -1'000, -250, 100);
  const auto frames = wheels.frames(base::Time{5'000});
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_TRUE(frames[0].extended);
  EXPECT_EQ(frames[0].id, 0x02041443U);
  EXPECT_EQ(bytes_of(frames[0].bytes()), hex("01 E2 40 FF 06 00 00 00"));
  EXPECT_EQ(bytes_of(frames[1].bytes()), hex("FF FC 18 00 64 00 00 00"));
}

}  // namespace
}  // namespace fencepost::emulate
