// Requirements on every I2C master, independent of the part. A master's own tests supply the part. `Bench` has the
// master, the part it talks to, and `settle()`, which runs until nothing more happens. It also says whether the part's
// interrupts are still on.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hal/base/result.hpp"

namespace fencepost::test {

using Bytes = std::vector<std::uint8_t>;

/// The device behind a part, as the part sees it, and a bench's counters.
struct I2cDevice {
  std::uint8_t device = 0x54;   ///< its address
  Bytes answers;                ///< read from it, byte by byte
  std::size_t refuses_at = 99;  ///< it does not acknowledge this byte of a write
  bool holds_clock = false;     ///< nothing goes on

  Bytes written;
  std::size_t given = 0;  ///< since it was addressed for reading
  int starts = 0;
  int stops = 0;
  int restarts = 0;

  [[nodiscard]] std::uint8_t answer() {
    const std::size_t k = given++;
    return k < answers.size() ? answers[k] : std::uint8_t{0xFF};
  }
};

/// The master keeps its registers by value; the bench wants to see them.
template <class Part>
struct Wires {
  Part* part;
  [[nodiscard]] std::uint32_t read(std::uint32_t offset) const { return part->read(offset); }
  void write(std::uint32_t offset, std::uint32_t value) const { part->write(offset, value); }
  void restart() const { part->restart(); }
};

template <class Bench>
class EveryI2cMaster : public Bench {
 public:
  base::Result<std::size_t> transfer(const Bytes& out, std::size_t expected) {
    const auto begun = this->master.begin(this->part.device, out, expected);
    if (!begun) return begun.error();
    this->settle();
    return this->master.finish(in);
  }
  std::array<std::uint8_t, 32> in{};
};
TYPED_TEST_SUITE_P(EveryI2cMaster);

TYPED_TEST_P(EveryI2cMaster, Writes) {
  const auto done = this->transfer({0x42, 0x01, 0x99}, 0);
  ASSERT_TRUE(done);
  EXPECT_EQ(*done, 0U);
  EXPECT_EQ(this->part.written, (Bytes{0x42, 0x01, 0x99}));
  EXPECT_EQ(this->part.starts, 1);
  EXPECT_EQ(this->part.stops, 1);
  EXPECT_FALSE(this->interrupts_on());
}

TYPED_TEST_P(EveryI2cMaster, ReadsAsManyAsWereAskedForAndNotOneMore) {
  for (std::uint8_t i = 0; i < 32; ++i) this->part.answers.push_back(static_cast<std::uint8_t>(100 + i));
  for (std::size_t expected = 1; expected <= 32; ++expected) {
    SCOPED_TRACE(expected);
    this->part.stops = 0;
    const auto done = this->transfer({}, expected);
    ASSERT_TRUE(done);
    EXPECT_EQ(*done, expected);
    EXPECT_EQ(this->part.given, expected) << "one more would be lost";
    EXPECT_EQ(this->part.stops, 1);
    for (std::size_t i = 0; i < expected; ++i) EXPECT_EQ(this->in[i], 100 + i);
  }
}

TYPED_TEST_P(EveryI2cMaster, WritesThenReadsAfterARepeatedStart) {
  this->part.answers = {0xAA, 0xBB};
  const auto done = this->transfer({0x42, 0x07}, 2);
  ASSERT_TRUE(done);
  EXPECT_EQ(*done, 2U);
  EXPECT_EQ(this->in[0], 0xAA);
  EXPECT_EQ(this->in[1], 0xBB);
  EXPECT_EQ(this->part.written, (Bytes{0x42, 0x07}));
  EXPECT_EQ(this->part.starts, 2);
  EXPECT_EQ(this->part.stops, 1);
}

TYPED_TEST_P(EveryI2cMaster, SaysSoWhereNobodyAcknowledges) {
  this->part.device = 0x01;
  ASSERT_TRUE(this->master.begin(0x54, Bytes{1}, 0));
  this->settle();
  EXPECT_EQ(this->master.finish(this->in).error(), base::Error::kRefused);
  ASSERT_TRUE(this->master.begin(0x54, {}, 4));
  this->settle();
  EXPECT_EQ(this->master.finish(this->in).error(), base::Error::kRefused);
  EXPECT_EQ(this->part.stops, 2);
  this->part.refuses_at = 1;
  EXPECT_EQ(this->transfer({1, 2, 3}, 0).error(), base::Error::kRefused);
  this->part.refuses_at = 99;
  EXPECT_TRUE(this->transfer({1, 2, 3}, 0)) << "the bus is free again";
  EXPECT_EQ(this->part.restarts, 0);
}

TYPED_TEST_P(EveryI2cMaster, GivesUpADeviceThatHoldsTheClockAndStartsThePartAnew) {
  this->part.holds_clock = true;
  ASSERT_TRUE(this->master.begin(0x54, Bytes{1}, 2));
  for (int ms = 0; ms < 29; ++ms) {
    this->master.on_millisecond();
    EXPECT_EQ(this->master.finish(this->in).error(), base::Error::kNotReady);
  }
  EXPECT_EQ(this->master.begin(0x54, Bytes{1}, 0).error(), base::Error::kFull);
  this->master.on_millisecond();
  EXPECT_EQ(this->master.finish(this->in).error(), base::Error::kRefused);
  EXPECT_EQ(this->part.restarts, 1);
  EXPECT_FALSE(this->interrupts_on());
  this->part.holds_clock = false;
  this->part.answers = {7};
  ASSERT_TRUE(this->transfer({}, 1));
  EXPECT_EQ(this->in[0], 7);
}

// Who began it is gone: another device is on the bus now.
TYPED_TEST_P(EveryI2cMaster, AbandonsWhatIsUnderWay) {
  this->part.holds_clock = true;
  ASSERT_TRUE(this->master.begin(0x54, Bytes{1}, 2));
  this->master.abandon();
  this->part.restart();
  EXPECT_FALSE(this->interrupts_on());
  EXPECT_EQ(this->master.finish(this->in).error(), base::Error::kNotReady);
  this->part.holds_clock = false;
  this->part.answers = {7};
  ASSERT_TRUE(this->transfer({}, 1));
  EXPECT_EQ(this->in[0], 7);
}

TYPED_TEST_P(EveryI2cMaster, RefusesWhatIsNoTransfer) {
  EXPECT_EQ(this->master.begin(0x54, {}, 0).error(), base::Error::kFull);
  EXPECT_EQ(this->master.begin(0x54, Bytes(33), 0).error(), base::Error::kFull);
  EXPECT_EQ(this->master.begin(0x54, {}, 33).error(), base::Error::kFull);
  EXPECT_EQ(this->master.finish(this->in).error(), base::Error::kNotReady);
  EXPECT_EQ(this->part.starts, 0);
}

REGISTER_TYPED_TEST_SUITE_P(EveryI2cMaster, Writes, ReadsAsManyAsWereAskedForAndNotOneMore,
                            WritesThenReadsAfterARepeatedStart, SaysSoWhereNobodyAcknowledges,
                            GivesUpADeviceThatHoldsTheClockAndStartsThePartAnew, AbandonsWhatIsUnderWay,
                            RefusesWhatIsNoTransfer);

}  // namespace fencepost::test
