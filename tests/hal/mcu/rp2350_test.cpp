// The RP2350 port's decisions that can be tested on the desk; the rest is started in tests/boards/rp2350.
#include <gtest/gtest.h>

#include "hal/mcu/rp2/reset_reason.hpp"
#include "hal/mcu/rp2/watchdog.hpp"

namespace fencepost::mcu::rp2 {
namespace {

TEST(Rp2350, TellsWhyItWasReset) {
  EXPECT_EQ(reset_reason(0, false, 1U << 16), ResetReason::kPowerOn);
  EXPECT_EQ(reset_reason(0, false, 1U << 17), ResetReason::kBrownOut);
  EXPECT_EQ(reset_reason(0, true, 1U << 18), ResetReason::kPin);
  EXPECT_EQ(reset_reason(0, true, 1U << 19), ResetReason::kSoftware);
  EXPECT_EQ(reset_reason(1, true, 1U << 16), ResetReason::kWatchdog);
  EXPECT_EQ(reset_reason(1, false, 1U << 16), ResetReason::kSoftware) << "the boot loader's timer is none of ours";
  EXPECT_EQ(reset_reason(0, false, 0), ResetReason::kUnknown);
}

// Microseconds, in 24 bits.
TEST(Rp2350, WatchdogCountsOncePerMicrosecond) {
  EXPECT_EQ(kWatchdogCount, 400'000U);
  EXPECT_LT(kPatientCount, 1U << 24);
}

}  // namespace
}  // namespace fencepost::mcu::rp2
