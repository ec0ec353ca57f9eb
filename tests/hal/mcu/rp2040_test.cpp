// The RP2040 port's decisions that can be tested on the desk; the rest runs in the emulator (tests/boards/pico).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <span>

#include "hal/mcu/rp2/reset_reason.hpp"
#include "hal/mcu/rp2/usb_descriptors.hpp"

namespace fencepost::mcu::rp2 {
namespace {

TEST(Rp2040, TellsWhyItWasReset) {
  EXPECT_EQ(reset_reason(0, false, 1U << 8), ResetReason::kPowerOn);
  EXPECT_EQ(reset_reason(0, true, 1U << 16), ResetReason::kPin);
  EXPECT_EQ(reset_reason(0, true, 1U << 20), ResetReason::kSoftware);
  EXPECT_EQ(reset_reason(1, true, 1U << 8), ResetReason::kWatchdog);
  EXPECT_EQ(reset_reason(1, false, 1U << 8), ResetReason::kSoftware) << "the boot loader's timer is none of ours";
  EXPECT_EQ(reset_reason(2, true, 1U << 8), ResetReason::kSoftware);
  EXPECT_EQ(reset_reason(0, false, 0), ResetReason::kUnknown);
}

// USB 2.0 9.5: each descriptor begins with its length and its kind; the configuration holds the sum of its own.
TEST(Rp2040, DescriptorsAreAsLongAsTheySay) {
  EXPECT_EQ(usb::kDevice[0], usb::kDevice.size());
  EXPECT_EQ(usb::kLanguage[0], usb::kLanguage.size());
  EXPECT_EQ(usb::kName[0], usb::kName.size());
  EXPECT_EQ(usb::kConfiguration[2] | (usb::kConfiguration[3] << 8), static_cast<int>(usb::kConfiguration.size()));
  std::size_t at = 0;
  int interfaces = 0;
  int endpoints = 0;
  while (at < usb::kConfiguration.size()) {
    ASSERT_GE(usb::kConfiguration[at], 2);
    interfaces += usb::kConfiguration[at + 1] == 4 ? 1 : 0;
    endpoints += usb::kConfiguration[at + 1] == 5 ? 1 : 0;
    at += usb::kConfiguration[at];
  }
  EXPECT_EQ(at, usb::kConfiguration.size());
  EXPECT_EQ(interfaces, usb::kConfiguration[4]);
  EXPECT_EQ(endpoints, 3);
}

TEST(Rp2040, ASerialNumberIsSixteenDigitsInUtf16) {
  const std::array<std::uint8_t, 34> string = {34,  3, '0', 0, '1', 0, '2', 0, '3', 0, '4', 0, '5', 0, '6', 0, '7', 0,
                                               '8', 0, '9', 0, 'A', 0, 'B', 0, 'C', 0, 'D', 0, 'E', 0, 'F', 0};
  EXPECT_EQ(usb::serial_number(0x0123'4567'89AB'CDEF), string);
  EXPECT_EQ(usb::kDevice[usb::kSerialIndexAt], 0) << "until there is one";
}

// Windows then loads its driver for serial lines: EF/02/01, and one association of class 02/02.
TEST(Rp2040, DescriptorsSayThatBothInterfacesAreOneSerialLine) {
  EXPECT_EQ(usb::kDevice[4], 0xEF);
  EXPECT_EQ(usb::kDevice[5], 2);
  EXPECT_EQ(usb::kDevice[6], 1);
  const std::array<std::uint8_t, 8> association = {8, 11, 0, 2, 2, 2, 0, 0};
  EXPECT_TRUE(std::ranges::equal(association, std::span(usb::kConfiguration).subspan(9, 8)));
}

}  // namespace
}  // namespace fencepost::mcu::rp2
