// The I2C master of the nRF51822, with the part simulated after chapter 28 of its manual.
#include "hal/mcu/nrf51/twi_master.hpp"

#include <gtest/gtest.h>

#include <cstdint>

#include "hal/bus/i2c_bus.hpp"
#include "hal/mcu/nrf51/reset_reason.hpp"
#include "hal/mcu/nrf51/uart.hpp"
#include "hal/mcu/nrf52/reset_reason.hpp"
#include "tests/hal/mcu/i2c_master_suite.hpp"

namespace fencepost::mcu::nrf51 {
namespace {

/// The master's registers, and one device behind them.
struct Part : test::I2cDevice {
  std::uint32_t address = 0;
  std::uint32_t shorts = 0;
  std::uint32_t interrupts = 0;
  std::uint32_t txd = 0;
  std::uint32_t rxd = 0;
  bool reading = false;
  bool suspended = false;
  bool txd_waits = false;
  std::uint32_t received_event = 0;
  std::uint32_t sent_event = 0;
  std::uint32_t stopped_event = 0;
  std::uint32_t error_event = 0;

  std::uint32_t* event(std::uint32_t offset) {
    switch (offset) {
      case kTwiReceived: return &received_event;
      case kTwiSent: return &sent_event;
      case kTwiStopped: return &stopped_event;
      case kTwiError: return &error_event;
      default: return nullptr;
    }
  }
  std::uint32_t read(std::uint32_t offset) {
    if (const std::uint32_t* const found = event(offset)) return *found;
    return offset == kTwiRxd ? rxd : 0;
  }
  void write(std::uint32_t offset, std::uint32_t value) {
    if (std::uint32_t* const found = event(offset)) *found = value;
    switch (offset) {
      case kTwiAddress: address = value; break;
      case kTwiShorts: shorts = value; break;
      case kTwiInterruptsOn: interrupts |= value; break;
      case kTwiInterruptsOff: interrupts &= ~value; break;
      case kTwiTxd:
        txd = value;
        txd_waits = true;
        break;
      case kTwiStartWriting:
        ++starts;
        reading = false;
        break;
      case kTwiStartReading:
        ++starts;
        reading = true;
        suspended = false;
        given = 0;
        break;
      case kTwiResume: suspended = false; break;
      case kTwiStop: stop(); break;
      default: break;
    }
  }
  void restart() {
    ++restarts;
    reading = suspended = txd_waits = false;
    received_event = sent_event = stopped_event = error_event = 0;
  }
  void stop() {
    ++stops;
    reading = false;
    stopped_event = 1;
  }

  /// A byte on the wires, if one can go; true if something happened.
  bool advance() {
    if (holds_clock) return false;
    if (txd_waits && !reading) {
      txd_waits = false;
      if (address != device || written.size() == refuses_at) {
        error_event = 1;
      } else {
        written.push_back(static_cast<std::uint8_t>(txd));
        sent_event = 1;
      }
      return true;
    }
    if (!reading || suspended) return false;
    if (address != device) {
      reading = false;
      error_event = 1;
      return true;
    }
    EXPECT_EQ(received_event, 0U) << "anomaly 56: a byte comes while the last one is unread";
    rxd = answer();
    received_event = 1;
    if ((shorts & kTwiSuspendAfterByte) != 0) suspended = true;
    if ((shorts & kTwiStopAfterByte) != 0) stop();
    return true;
  }
};

using Wires = test::Wires<Part>;
static_assert(bus::I2cBus<TwiMaster<Wires>>);

class TwiBench : public ::testing::Test {
 protected:
  // Interrupts come as long as anything happens and they are on; late, when the part has gone as far as it can.
  void settle() {
    for (int i = 0; i < 200; ++i) {
      int steps = 0;
      while (steps < 5 && part.advance()) ++steps;
      if (interrupts_on()) master.on_interrupt();
      if (steps == 0) return;
    }
    FAIL() << "it never ends";
  }
  [[nodiscard]] bool interrupts_on() const { return part.interrupts != 0; }

  Part part;
  TwiMaster<Wires> master{Wires{&part}};
};

// Switching a master's interrupts off does not take back one that is already pending in the core.
TEST_F(TwiBench, AnInterruptThatWasPendingDoesNotEndWhatWasAbandoned) {
  part.answers = {7, 8};
  ASSERT_TRUE(master.begin(part.device, {}, 1));
  ASSERT_TRUE(part.advance());
  ASSERT_NE(part.stopped_event, 0U);
  master.abandon();
  master.on_interrupt();
  part.restart();
  ASSERT_TRUE(master.begin(part.device, {}, 1)) << "the bus is taken for ever";
  settle();
  std::array<std::uint8_t, 1> in{};
  ASSERT_TRUE(master.finish(in));
  EXPECT_EQ(in[0], 7);
}

}  // namespace
}  // namespace fencepost::mcu::nrf51

namespace fencepost::test {
namespace {
INSTANTIATE_TYPED_TEST_SUITE_P(Nrf51, EveryI2cMaster, mcu::nrf51::TwiBench);
}  // namespace
}  // namespace fencepost::test

namespace fencepost::mcu::nrf51 {
namespace {

TEST(Nrf51ResetReason, TellsTheFirstFlagThatSaysSomething) {
  EXPECT_EQ(reset_reason(0), ResetReason::kPowerOn);
  EXPECT_EQ(reset_reason(1U << 0), ResetReason::kPin);
  EXPECT_EQ(reset_reason((1U << 1) | (1U << 0)), ResetReason::kWatchdog);
  EXPECT_EQ(reset_reason(1U << 2), ResetReason::kSoftware);
  EXPECT_EQ(reset_reason((1U << 3) | (1U << 2)), ResetReason::kPanic);
  EXPECT_EQ(reset_reason(1U << 16), ResetReason::kUnknown);  // woken by a pin from the deepest sleep: never slept
}

// Anomaly 136 of the nRF52833: the others mean nothing behind a reset by the pin.
TEST(Nrf52ResetReason, TellsThePinBeforeAllOthers) {
  EXPECT_EQ(nrf52::reset_reason(0), ResetReason::kPowerOn);
  EXPECT_EQ(nrf52::reset_reason((1U << 1) | (1U << 0)), ResetReason::kPin);
  EXPECT_EQ(nrf52::reset_reason(1U << 1), ResetReason::kWatchdog);
  EXPECT_EQ(nrf52::reset_reason(1U << 20), ResetReason::kUnknown);  // woken by USB
}

// The values that the manual's table has.
TEST(Nrf51Uart, SetsItsBaudAsTheManualSays) {
  EXPECT_EQ(baud_setting(9'600), 0x0027'5000U);
  EXPECT_EQ(baud_setting(38'400), 0x009D'5000U);
  EXPECT_EQ(baud_setting(115'200), 0x01D7'E000U);
  EXPECT_EQ(baud_setting(1'000'000), 0x1000'0000U);
}

}  // namespace
}  // namespace fencepost::mcu::nrf51
