// The two-wire master of the STM32F405, with the part played by chapter 27.3.3 of its manual: when which bit is set,
// what clears it, and which byte the acknowledge is for. No emulator has this bus.
#include "hal/mcu/stm32f4/i2c_master.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "hal/bus/i2c_bus.hpp"

namespace fencepost::mcu::stm32f4 {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// The master's registers, and one device behind them.
struct Part {
  std::uint8_t device = 0x54;
  Bytes answers;                ///< what the device gives, byte by byte
  std::size_t refuses_at = 99;  ///< does not acknowledge this byte of a write
  bool holds_clock = false;     ///< nothing goes on
  bool stop_hangs = false;      ///< the stop never gets onto the wires

  Bytes written;
  std::size_t given = 0;
  std::size_t refused = 0;  ///< bytes of the device that were not acknowledged
  int starts = 0;
  int stops = 0;
  int restarts = 0;

  std::uint32_t control1 = kI2cEnable;
  std::uint32_t control2 = 0;
  std::uint32_t status1 = 0;
  bool busy = false;
  bool reading = false;
  bool addressed = false;
  bool talking = false;  ///< the device gives its next byte
  bool status_seen = false;
  std::optional<std::uint8_t> to_send;
  std::optional<std::uint8_t> data;
  std::optional<std::uint8_t> shift;

  [[nodiscard]] bool on(std::uint32_t bit) const { return (status1 & bit) != 0; }

  std::uint32_t read(std::uint32_t offset) {
    switch (offset) {
      case kI2cControl1: return control1;
      case kI2cControl2: return control2;
      case kI2cStatus1: status_seen = true; return status1;
      case kI2cStatus2:
        if (status_seen && on(kI2cAddressed)) {
          status1 &= ~kI2cAddressed;
          addressed = talking = true;
        }
        return busy ? kI2cBusy : 0;
      case kI2cData: return take_data();
      default: return 0;
    }
  }
  std::uint32_t take_data() {
    EXPECT_TRUE(data.has_value()) << "read before anything has come";
    const std::uint8_t byte = data.value_or(0xEE);
    data = shift;
    shift.reset();
    status1 &= ~(kI2cByteFinished | kI2cReceived);
    if (data) status1 |= kI2cReceived;
    return byte;
  }
  void write(std::uint32_t offset, std::uint32_t value) {
    switch (offset) {
      case kI2cControl1: control1 = value; break;
      case kI2cControl2: control2 = value; break;
      case kI2cStatus1: status1 &= value | ~kI2cErrors; break;
      case kI2cData:
        EXPECT_FALSE(to_send.has_value()) << "written over";
        to_send = static_cast<std::uint8_t>(value);
        status1 &= ~kI2cByteFinished;
        break;
      default: break;
    }
  }
  void restart() {
    ++restarts;
    control1 = kI2cEnable;
    control2 = status1 = 0;
    busy = reading = addressed = talking = false;
    to_send.reset();
    data.reset();
    shift.reset();
  }

  /// One thing on the wires, if one can happen.
  bool advance() {
    if (holds_clock) return false;
    const bool byte_under_way = addressed && reading && talking && !shift;
    if ((control1 & kI2cStop) != 0 && !byte_under_way) return !stop_hangs && stop();
    if ((control1 & kI2cStart) != 0) return start();
    if (on(kI2cStarted)) return address();
    if (!addressed || on(kI2cNoAcknowledge)) return false;
    return reading ? receive() : send();
  }
  bool start() {
    ++starts;
    busy = true;
    addressed = talking = false;
    control1 &= ~kI2cStart;
    status1 = kI2cStarted;
    return true;
  }
  bool stop() {
    ++stops;
    busy = addressed = talking = false;
    control1 &= ~kI2cStop;
    return true;
  }
  bool address() {
    if (!to_send) return false;
    status1 &= ~kI2cStarted;
    reading = (*to_send & 1U) != 0;
    status1 |= *to_send >> 1U == device ? kI2cAddressed : kI2cNoAcknowledge;
    to_send.reset();
    status_seen = false;
    return true;
  }
  bool send() {
    if (!to_send) return false;
    if (written.size() == refuses_at) {
      status1 |= kI2cNoAcknowledge;
    } else {
      written.push_back(*to_send);
      status1 |= kI2cByteFinished;
    }
    to_send.reset();
    return true;
  }
  // Into the data register, else into the shift register, else the clock is held. The acknowledge is set by the bit as
  // it is when the byte ends; with POS it is that of the second byte.
  bool receive() {
    if (!talking || shift) return false;
    const std::uint8_t byte = given < answers.size() ? answers[given] : 0xFF;
    ++given;
    const bool first_of_two = (control1 & kI2cPosition) != 0 && given == 1;
    if ((control1 & kI2cAcknowledge) == 0 && !first_of_two) {
      talking = false;
      ++refused;
    }
    if (data) {
      shift = byte;
      status1 |= kI2cByteFinished;
    } else {
      data = byte;
      status1 |= kI2cReceived;
    }
    return true;
  }

  [[nodiscard]] bool event_pending() const {
    const std::uint32_t buffers = (control2 & kI2cBufferInterrupt) != 0 ? kI2cReceived : 0U;
    const std::uint32_t events = kI2cStarted | kI2cAddressed | kI2cByteFinished | buffers;
    return (control2 & kI2cEventInterrupt) != 0 && (status1 & events) != 0;
  }
  [[nodiscard]] bool error_pending() const {
    return (control2 & kI2cErrorInterrupt) != 0 && (status1 & kI2cErrors) != 0;
  }
};

/// The master keeps its registers by value; the bench wants to see them.
struct Wires {
  Part* part;
  [[nodiscard]] std::uint32_t read(std::uint32_t offset) const { return part->read(offset); }
  void write(std::uint32_t offset, std::uint32_t value) const { part->write(offset, value); }
  void restart() const { part->restart(); }
};
static_assert(bus::I2cBus<I2cMaster<Wires>>);

class I2cMasterTest : public ::testing::Test {
 protected:
  // Interrupts come at once, or when the wires have gone as far as they can: both happen on a robot.
  void settle(bool late) {
    for (int i = 0; i < 500; ++i) {
      bool happened = false;
      do {
        const bool moved = part.advance();
        happened = happened || moved;
        if (!moved) break;
      } while (late);
      if (part.event_pending()) {
        master.on_event();
        happened = true;
      }
      if (part.error_pending()) {
        master.on_error();
        happened = true;
      }
      if (!happened) return;
    }
    FAIL() << "it never ends";
  }
  base::Result<std::size_t> transfer(const Bytes& out, std::size_t expected, bool late = false) {
    const auto begun = master.begin(part.device, out, expected);
    if (!begun) return begun.error();
    settle(late);
    return master.finish(in);
  }

  Part part;
  I2cMaster<Wires> master{Wires{&part}};
  std::array<std::uint8_t, 32> in{};
};

TEST_F(I2cMasterTest, Writes) {
  const auto done = transfer({0x42, 0x01, 0x99}, 0);
  ASSERT_TRUE(done);
  EXPECT_EQ(*done, 0U);
  EXPECT_EQ(part.written, (Bytes{0x42, 0x01, 0x99}));
  EXPECT_EQ(part.starts, 1);
  EXPECT_EQ(part.stops, 1);
  EXPECT_EQ(part.control2 & kI2cEventInterrupt, 0U);
}

// One, two, three and more bytes are ended in three different ways (27.3.3, "closing the communication").
TEST_F(I2cMasterTest, ReadsAsManyAsWereAskedForAndRefusesTheLast) {
  for (std::uint8_t i = 0; i < 32; ++i) part.answers.push_back(static_cast<std::uint8_t>(100 + i));
  for (const bool late : {false, true}) {
    for (std::size_t expected = 1; expected <= 32; ++expected) {
      SCOPED_TRACE(std::to_string(expected) + (late ? " late" : ""));
      part.stops = 0;
      part.given = part.refused = 0;
      in.fill(0);
      const auto done = transfer({}, expected, late);
      ASSERT_TRUE(done);
      EXPECT_EQ(*done, expected);
      EXPECT_EQ(part.given, expected) << "one more would be lost";
      EXPECT_EQ(part.refused, 1U);
      EXPECT_FALSE(part.talking);
      EXPECT_EQ(part.stops, 1);
      for (std::size_t i = 0; i < expected; ++i) EXPECT_EQ(in[i], 100 + i);
    }
  }
}

TEST_F(I2cMasterTest, WritesThenReadsAfterARepeatedStart) {
  part.answers = {0xAA, 0xBB};
  const auto done = transfer({0x42, 0x07}, 2);
  ASSERT_TRUE(done);
  EXPECT_EQ(*done, 2U);
  EXPECT_EQ(in[0], 0xAA);
  EXPECT_EQ(in[1], 0xBB);
  EXPECT_EQ(part.written, (Bytes{0x42, 0x07}));
  EXPECT_EQ(part.starts, 2);
  EXPECT_EQ(part.stops, 1);
}

// Between the last byte's end and the repeated start the event is still pending; nothing may be taken for an answer.
TEST_F(I2cMasterTest, WaitsForTheRepeatedStart) {
  part.answers = {1, 2, 3};
  ASSERT_TRUE(master.begin(part.device, Bytes{0x42}, 3));
  while (part.written.empty()) {
    part.advance();
    if (part.event_pending()) master.on_event();
  }
  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE(part.event_pending());
    master.on_event();
  }
  settle(false);
  const auto done = master.finish(in);
  ASSERT_TRUE(done);
  EXPECT_EQ(*done, 3U);
  EXPECT_EQ(in[2], 3);
}

TEST_F(I2cMasterTest, SaysSoWhereNobodyAcknowledges) {
  ASSERT_TRUE(master.begin(0x01, Bytes{1}, 0));
  settle(false);
  EXPECT_EQ(master.finish(in).error(), base::Error::kRefused);
  ASSERT_TRUE(master.begin(0x01, {}, 4));
  settle(false);
  EXPECT_EQ(master.finish(in).error(), base::Error::kRefused);
  EXPECT_EQ(part.stops, 2);
  part.refuses_at = 1;
  EXPECT_EQ(transfer({1, 2, 3}, 0).error(), base::Error::kRefused);
  part.refuses_at = 99;
  EXPECT_TRUE(transfer({1, 2, 3}, 0)) << "the bus is free again";
  EXPECT_EQ(part.restarts, 0);
}

TEST_F(I2cMasterTest, GivesUpADeviceThatHoldsTheClockAndStartsThePartAnew) {
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
  part.holds_clock = false;
  part.answers = {7};
  ASSERT_TRUE(transfer({}, 1));
  EXPECT_EQ(in[0], 7);
}

// What was read is good; but the next start has to wait for this stop, and not for ever.
TEST_F(I2cMasterTest, WaitsForTheStopAndNotForEver) {
  part.answers = {9};
  part.stop_hangs = true;
  ASSERT_TRUE(master.begin(part.device, {}, 1));
  settle(false);
  EXPECT_EQ(master.finish(in).error(), base::Error::kNotReady);
  for (int ms = 0; ms < 30; ++ms) master.on_millisecond();
  ASSERT_TRUE(master.finish(in));
  EXPECT_EQ(in[0], 9);
  EXPECT_EQ(part.restarts, 1);
}

TEST_F(I2cMasterTest, FreesABusThatIsBusyBeforeItBegins) {
  part.busy = true;
  part.answers = {5};
  ASSERT_TRUE(transfer({}, 1));
  EXPECT_EQ(part.restarts, 1);
  EXPECT_EQ(in[0], 5);
}

TEST_F(I2cMasterTest, RefusesWhatIsNoTransfer) {
  EXPECT_EQ(master.begin(0x54, {}, 0).error(), base::Error::kFull);
  EXPECT_EQ(master.begin(0x54, Bytes(33), 0).error(), base::Error::kFull);
  EXPECT_EQ(master.begin(0x54, {}, 33).error(), base::Error::kFull);
  EXPECT_EQ(master.finish(in).error(), base::Error::kNotReady);
  EXPECT_EQ(part.starts, 0);
}

}  // namespace
}  // namespace fencepost::mcu::stm32f4
