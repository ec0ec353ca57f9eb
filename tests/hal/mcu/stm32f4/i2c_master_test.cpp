// The I2C master of the STM32F405, with the part simulated after chapter 27.3.3 of its manual. That says when each bit
// is set, what clears it, and which byte the acknowledge is for. No emulator has this bus.
#include "hal/mcu/stm32f4/i2c_master.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>

#include "hal/bus/i2c_bus.hpp"
#include "tests/hal/mcu/i2c_master_suite.hpp"

namespace fencepost::mcu::stm32f4 {
namespace {

using test::Bytes;

/// The master's registers, and one device behind them.
struct Part : test::I2cDevice {
  bool stop_hangs = false;  ///< the stop never gets onto the wires
  std::size_t refused = 0;  ///< bytes of the device that were not acknowledged

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
    given = 0;
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
    const std::uint8_t byte = answer();
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

using Wires = test::Wires<Part>;
static_assert(bus::I2cBus<I2cMaster<Wires>>);

// Interrupts come at once, or when the wires have gone as far as they can: both happen on a robot.
template <bool kLate>
class I2cBench : public ::testing::Test {
 public:
  void settle() {
    for (int i = 0; i < 500; ++i) {
      bool happened = false;
      do {
        const bool moved = part.advance();
        happened = happened || moved;
        if (!moved) break;
      } while (kLate);
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
  [[nodiscard]] bool interrupts_on() const { return (part.control2 & kI2cEventInterrupt) != 0; }

  Part part;
  I2cMaster<Wires> master{Wires{&part}};
};
using Prompt = I2cBench<false>;
using Late = I2cBench<true>;

}  // namespace
}  // namespace fencepost::mcu::stm32f4

namespace fencepost::test {
namespace {
using Stm32f4Benches = ::testing::Types<mcu::stm32f4::Prompt, mcu::stm32f4::Late>;
INSTANTIATE_TYPED_TEST_SUITE_P(Stm32f4, EveryI2cMaster, Stm32f4Benches);
}  // namespace
}  // namespace fencepost::test

namespace fencepost::mcu::stm32f4 {
namespace {

using I2cMasterTest = test::EveryI2cMaster<Prompt>;
using LateI2cMasterTest = test::EveryI2cMaster<Late>;

// One, two, three and more bytes are ended in three different ways (27.3.3, "closing the communication").
template <class Test>
void expect_last_byte_refused(Test& bench, std::size_t expected) {
  SCOPED_TRACE(expected);
  bench.part.refused = 0;
  ASSERT_TRUE(bench.transfer({}, expected));
  EXPECT_EQ(bench.part.refused, 1U);
  EXPECT_FALSE(bench.part.talking);
}
TEST_F(I2cMasterTest, RefusesTheLastByteAlone) {
  for (std::size_t expected = 1; expected <= 32; ++expected) expect_last_byte_refused(*this, expected);
}
TEST_F(LateI2cMasterTest, RefusesTheLastByteAlone) {
  for (std::size_t expected = 1; expected <= 32; ++expected) expect_last_byte_refused(*this, expected);
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
  settle();
  const auto done = master.finish(in);
  ASSERT_TRUE(done);
  EXPECT_EQ(*done, 3U);
  EXPECT_EQ(in[2], 3);
}

// The bytes that were read are good; but the next start has to wait for this stop, and not indefinitely.
TEST_F(I2cMasterTest, WaitsForTheStopAndNotForEver) {
  part.answers = {9};
  part.stop_hangs = true;
  ASSERT_TRUE(master.begin(part.device, {}, 1));
  settle();
  EXPECT_EQ(master.finish(in).error(), base::Error::kNotReady);
  for (int ms = 0; ms < 30; ++ms) master.on_millisecond();
  ASSERT_TRUE(master.finish(in));
  EXPECT_EQ(in[0], 9);
  EXPECT_EQ(part.restarts, 1);
}

// The part sees bus errors that are none while it is master (errata ES0182); the transfer is good.
TEST_F(I2cMasterTest, GoesOnAfterABusErrorAlone) {
  part.answers = {1, 2, 3};
  ASSERT_TRUE(master.begin(part.device, Bytes{0x42}, 3));
  part.status1 |= kI2cBusError;
  settle();
  EXPECT_EQ(part.status1 & kI2cBusError, 0U) << "or it interrupts for ever";
  const auto done = master.finish(in);
  ASSERT_TRUE(done);
  EXPECT_EQ(*done, 3U);
}
TEST_F(I2cMasterTest, StillSeesARefusalBesideABusError) {
  part.device = 0x20;
  ASSERT_TRUE(master.begin(0x54, Bytes{0x42}, 3));
  part.status1 |= kI2cBusError;
  settle();
  EXPECT_EQ(master.finish(in).error(), base::Error::kRefused);
}

TEST_F(I2cMasterTest, FreesABusThatIsBusyBeforeItBegins) {
  part.busy = true;
  part.answers = {5};
  ASSERT_TRUE(transfer({}, 1));
  EXPECT_EQ(part.restarts, 1);
  EXPECT_EQ(in[0], 5);
}

}  // namespace
}  // namespace fencepost::mcu::stm32f4
