// The two-wire master of the nRF51822, with the part played by chapter 28 of its manual.
#include "hal/mcu/nrf51/twi_master.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

#include "hal/bus/i2c_bus.hpp"
#include "hal/mcu/nrf51/reset_reason.hpp"
#include "hal/mcu/nrf51/uart.hpp"

namespace fencepost::mcu::nrf51 {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// The master's registers, and one device behind them.
struct Part {
  std::uint8_t device = 0x54;
  Bytes answers;                ///< what the device gives, byte by byte
  bool holds_clock = false;     ///< nothing goes on
  std::size_t refuses_at = 99;  ///< does not acknowledge this byte of a write

  Bytes written;
  int starts = 0;
  int stops = 0;
  int restarts = 0;
  std::uint32_t address = 0;
  std::uint32_t shorts = 0;
  std::uint32_t interrupts = 0;
  std::uint32_t txd = 0;
  std::uint32_t rxd = 0;
  std::size_t given = 0;
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
    rxd = given < answers.size() ? answers[given] : 0xFF;
    ++given;
    received_event = 1;
    if ((shorts & kTwiSuspendAfterByte) != 0) suspended = true;
    if ((shorts & kTwiStopAfterByte) != 0) stop();
    return true;
  }
};

/// The master keeps its registers by value; the bench wants to see them.
struct Wires {
  Part* part;
  [[nodiscard]] std::uint32_t read(std::uint32_t offset) const { return part->read(offset); }
  void write(std::uint32_t offset, std::uint32_t value) const { part->write(offset, value); }
  void restart() const { part->restart(); }
};
static_assert(bus::I2cBus<TwiMaster<Wires>>);

class TwiMasterTest : public ::testing::Test {
 protected:
  // Interrupts come as long as anything happens and they are on; late, when the part has gone as far as it can.
  void settle() {
    for (int i = 0; i < 200; ++i) {
      int steps = 0;
      while (steps < 5 && part.advance()) ++steps;
      if (part.interrupts != 0) master.on_interrupt();
      if (steps == 0) return;
    }
    FAIL() << "it never ends";
  }
  base::Result<std::size_t> transfer(const Bytes& out, std::size_t expected) {
    const auto begun = master.begin(part.device, out, expected);
    if (!begun) return begun.error();
    settle();
    return master.finish(in);
  }

  Part part;
  TwiMaster<Wires> master{Wires{&part}};
  std::array<std::uint8_t, 32> in{};
};

TEST_F(TwiMasterTest, Writes) {
  const auto done = transfer({0x42, 0x01, 0x99}, 0);
  ASSERT_TRUE(done);
  EXPECT_EQ(*done, 0U);
  EXPECT_EQ(part.written, (Bytes{0x42, 0x01, 0x99}));
  EXPECT_EQ(part.starts, 1);
  EXPECT_EQ(part.stops, 1);
  EXPECT_EQ(part.interrupts, 0U);
}

TEST_F(TwiMasterTest, ReadsAsManyAsWereAskedForAndNotOneMore) {
  part.answers = {1, 2, 3, 4};
  for (std::size_t expected = 1; expected <= 4; ++expected) {
    part.stops = 0;
    const auto done = transfer({}, expected);
    ASSERT_TRUE(done);
    EXPECT_EQ(*done, expected);
    EXPECT_EQ(part.given, expected);
    EXPECT_EQ(part.stops, 1);
    EXPECT_EQ(in[expected - 1], expected);
  }
}

TEST_F(TwiMasterTest, WritesThenReadsAfterARepeatedStart) {
  part.answers = {0xAA, 0xBB};
  const auto done = transfer({0x42}, 2);
  ASSERT_TRUE(done);
  EXPECT_EQ(*done, 2U);
  EXPECT_EQ(in[0], 0xAA);
  EXPECT_EQ(in[1], 0xBB);
  EXPECT_EQ(part.starts, 2);
  EXPECT_EQ(part.stops, 1);
}

TEST_F(TwiMasterTest, SaysSoWhereNobodyAcknowledges) {
  ASSERT_TRUE(master.begin(0x01, Bytes{1}, 0));
  settle();
  EXPECT_EQ(master.finish(in).error(), base::Error::kRefused);
  ASSERT_TRUE(master.begin(0x01, {}, 4));
  settle();
  EXPECT_EQ(master.finish(in).error(), base::Error::kRefused);
  part.refuses_at = 1;
  EXPECT_EQ(transfer({1, 2, 3}, 0).error(), base::Error::kRefused);
  part.refuses_at = 99;
  EXPECT_TRUE(transfer({1, 2, 3}, 0)) << "the bus is free again";
}

TEST_F(TwiMasterTest, GivesUpADeviceThatHoldsTheClockAndStartsThePartAnew) {
  part.holds_clock = true;
  ASSERT_TRUE(master.begin(part.device, Bytes{1}, 2));
  for (int ms = 0; ms < 29; ++ms) {
    master.on_millisecond();
    EXPECT_EQ(master.finish(in).error(), base::Error::kNotReady);
  }
  EXPECT_EQ(master.begin(part.device, Bytes{1}, 0).error(), base::Error::kFull);
  master.on_millisecond();
  EXPECT_EQ(master.finish(in).error(), base::Error::kRefused);
  EXPECT_EQ(part.restarts, 1);
  EXPECT_EQ(part.interrupts, 0U);
  part.holds_clock = false;
  part.answers = {7};
  const auto done = transfer({}, 1);
  ASSERT_TRUE(done);
  EXPECT_EQ(in[0], 7);
}

TEST_F(TwiMasterTest, RefusesWhatIsNoTransfer) {
  EXPECT_EQ(master.begin(0x54, {}, 0).error(), base::Error::kFull);
  EXPECT_EQ(master.begin(0x54, Bytes(33), 0).error(), base::Error::kFull);
  EXPECT_EQ(master.begin(0x54, {}, 33).error(), base::Error::kFull);
  EXPECT_EQ(master.finish(in).error(), base::Error::kNotReady);
  EXPECT_EQ(part.starts, 0);
}

TEST(Nrf51ResetReason, TellsTheFirstFlagThatSaysSomething) {
  EXPECT_EQ(reset_reason(0), ResetReason::kPowerOn);
  EXPECT_EQ(reset_reason(1U << 0), ResetReason::kPin);
  EXPECT_EQ(reset_reason((1U << 1) | (1U << 0)), ResetReason::kWatchdog);
  EXPECT_EQ(reset_reason(1U << 2), ResetReason::kSoftware);
  EXPECT_EQ(reset_reason((1U << 3) | (1U << 2)), ResetReason::kPanic);
  EXPECT_EQ(reset_reason(1U << 16), ResetReason::kUnknown);  // woken by a pin from the deepest sleep: never slept
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
