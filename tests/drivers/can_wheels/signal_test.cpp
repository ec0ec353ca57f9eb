// The frames of the devices' descriptions, byte by byte.
#include "drivers/can_wheels/signal.hpp"

#include <gtest/gtest.h>

#include "drivers/can_wheels/layouts.hpp"
#include "tests/drivers/hex.hpp"

namespace fencepost::can_wheels {
namespace {

bus::CanFrame frame(std::uint32_t id, bool extended, const std::string& text) {
  bus::CanFrame frame;
  frame.id = id;
  frame.extended = extended;
  for (const std::uint8_t byte : test::hex(text)) frame.data.at(frame.length++) = byte;
  return frame;
}

TEST(CanSignal, CanopenPositions) {
  EXPECT_EQ(value_in(frame(0x185, false, "37 06 A0 86 01 00"), canopen_position(5)), 100'000);
  EXPECT_EQ(value_in(frame(0x185, false, "37 06 C0 1D FE FF"), canopen_position(5)), -123'456);
}

TEST(CanSignal, TalonSrxPositionsAndVelocities) {
  const auto forward = frame(0x02041443, true, "01 E2 40 FF 06 00 00 00");
  EXPECT_EQ(talon_srx_status2(3), 0x0204'1443U);
  EXPECT_EQ((FrcId{7, 8, 63, 15, 63}.id()), 0x0708'FFFFU);
  EXPECT_EQ(value_in(forward, talon_srx_position(3)), 123'456);
  EXPECT_EQ(value_in(forward, talon_srx_velocity(3)), -250);
  const auto back = frame(0x02041443, true, "FF FC 18 00 64 00 00 00");
  EXPECT_EQ(value_in(back, talon_srx_position(3)), -1'000);
  EXPECT_EQ(value_in(back, talon_srx_velocity(3)), 100);
}

TEST(CanSignal, SizesOrdersAndSigns) {
  const auto bytes = frame(1, false, "80 01 FF FE 7F 00 00 80");
  EXPECT_EQ(value_in(bytes, {1, false, 0, 1, false, false}), 0x80);
  EXPECT_EQ(value_in(bytes, {1, false, 0, 1, false, true}), -128);
  EXPECT_EQ(value_in(bytes, {1, false, 2, 2, false, false}), 0xFEFF);
  EXPECT_EQ(value_in(bytes, {1, false, 2, 2, true, true}), -2);
  EXPECT_EQ(value_in(bytes, {1, false, 2, 3, false, true}), 0x7FFEFF);
  EXPECT_EQ(value_in(bytes, {1, false, 4, 4, false, true}), -0x7FFFFF81);
  EXPECT_EQ(value_in(bytes, {1, false, 4, 4, false, false}), 0x8000007F);
}

TEST(CanSignal, OtherFramesHaveNoValue) {
  const Signal signal{0x185, false, 2, 4, false, true};
  EXPECT_FALSE(value_in(frame(0x186, false, "37 06 A0 86 01 00"), signal));
  EXPECT_FALSE(value_in(frame(0x185, true, "37 06 A0 86 01 00"), signal));
  EXPECT_FALSE(value_in(frame(0x185, false, "37 06 A0 86 01"), signal));
  bus::CanFrame remote = frame(0x185, false, "37 06 A0 86 01 00");
  remote.remote = true;
  EXPECT_FALSE(value_in(remote, signal));
  EXPECT_FALSE(carries(remote, signal));
  bus::CanFrame too_long = frame(0x185, false, "37 06 A0 86 01 00 00 00");
  EXPECT_TRUE(value_in(too_long, signal));
  too_long.length = 9;  // longer than a frame can be
  EXPECT_FALSE(value_in(too_long, signal));
}

}  // namespace
}  // namespace fencepost::can_wheels
