#include "drivers/wire/i2c_stream.hpp"

#include <gtest/gtest.h>

#include "hal/fake/scripted_i2c.hpp"

namespace fencepost::wire {
namespace {

using base::Error;
using Bus = fake::ScriptedI2c<8>;

static_assert(bus::ByteLink<I2cStream<Bus>>);

constexpr std::array<std::uint8_t, 3> kSent = {1, 2, 3};

TEST(I2cStream, ReadsInChunksOfSixteen) {
  const std::array<fake::I2cStep, 1> script = {{{kSent, {}, 1}}};
  Bus bus(script);
  I2cStream<Bus> stream(bus, 0x54);
  std::array<std::uint8_t, 2> in{};
  EXPECT_EQ(stream.read(in).error(), Error::kNotReady);  // begins
  EXPECT_EQ(stream.read(in).error(), Error::kNotReady);  // under way
  EXPECT_EQ(stream.read(in).value(), 2U);
  EXPECT_EQ(stream.read(in).value(), 1U);
  EXPECT_EQ(in[0], 3);
  ASSERT_EQ(bus.transfers().size(), 1U);
  EXPECT_EQ(bus.transfers()[0].address, 0x54);
  EXPECT_EQ(bus.transfers()[0].expected, 16U);
}

TEST(I2cStream, WritesBetweenReadsWithoutLosingBytes) {
  const std::array<fake::I2cStep, 3> script = {{{kSent, {}, 0}, {{}, {}, 0}, {kSent, {}, 0}}};
  Bus bus(script);
  I2cStream<Bus> stream(bus, 0x54);
  std::array<std::uint8_t, 16> in{};
  EXPECT_EQ(stream.read(in).error(), Error::kNotReady);
  EXPECT_EQ(stream.write(kSent).value(), 3U);  // takes in the read that was under way
  EXPECT_EQ(stream.read(in).value(), 3U);
  EXPECT_EQ(stream.read(in).error(), Error::kNotReady);  // the write ends
  EXPECT_EQ(stream.read(in).error(), Error::kNotReady);  // a read begins
  EXPECT_EQ(stream.read(in).value(), 3U);
  ASSERT_EQ(bus.transfers().size(), 3U);
  EXPECT_EQ(bus.transfers()[1].out.size(), 3U);
}

// A loop turns: it reads until there is nothing, then it writes. Each transfer ends between two turns.
TEST(I2cStream, AReaderThatNeverRestsLeavesTheBusToAWriter) {
  const std::array<fake::I2cStep, 4> script = {{{kSent, {}, 1}, {{}, {}, 1}, {kSent, {}, 1}, {kSent, {}, 1}}};
  Bus bus(script);
  I2cStream<Bus> stream(bus, 0x54);
  std::array<std::uint8_t, 16> in{};
  const auto read_all = [&] {
    while (stream.read(in)) {
    }
  };
  read_all();
  EXPECT_EQ(stream.write(kSent).error(), Error::kFull);
  read_all();
  ASSERT_TRUE(stream.write(kSent)) << "the reader keeps the bus";
  EXPECT_EQ(bus.transfers().back().out.size(), 3U);
}

// A writer that got its turn has no more to wait for: the next read begins as soon as the write is over.
TEST(I2cStream, AWriterThatHadItsTurnCostsTheReaderNone) {
  const std::array<fake::I2cStep, 3> script = {{{kSent, {}, 1}, {{}, {}, 0}, {kSent, {}, 0}}};
  Bus bus(script);
  I2cStream<Bus> stream(bus, 0x54);
  std::array<std::uint8_t, 16> in{};
  EXPECT_EQ(stream.read(in).error(), Error::kNotReady);
  EXPECT_EQ(stream.write(kSent).error(), Error::kFull);
  EXPECT_EQ(stream.read(in).value(), 3U);
  ASSERT_TRUE(stream.write(kSent));
  EXPECT_EQ(stream.read(in).error(), Error::kNotReady);  // the write ends
  EXPECT_EQ(stream.read(in).error(), Error::kNotReady);  // a read begins
  EXPECT_EQ(stream.read(in).value(), 3U);
}

TEST(I2cStream, AWholeChunkIsGivenInParts) {
  std::array<std::uint8_t, 16> sixteen{};
  for (std::size_t i = 0; i < sixteen.size(); ++i) sixteen[i] = static_cast<std::uint8_t>(i + 1);
  const std::array<fake::I2cStep, 3> script = {{{sixteen, {}, 0}, {{}, {}, 0}, {kSent, {}, 0}}};
  Bus bus(script);
  I2cStream<Bus> stream(bus, 0x54);
  std::array<std::uint8_t, 10> in{};
  EXPECT_EQ(stream.read(in).error(), Error::kNotReady);
  EXPECT_EQ(stream.read(in).value(), 10U);
  EXPECT_EQ(in[9], 10);
  EXPECT_EQ(stream.write(kSent).value(), 3U) << "between two parts";
  EXPECT_EQ(stream.read(in).value(), 6U);
  EXPECT_EQ(in[0], 11);
  EXPECT_EQ(in[5], 16);
  EXPECT_EQ(stream.read(in).error(), Error::kNotReady);  // the write ends
  EXPECT_EQ(stream.read(in).error(), Error::kNotReady);  // a read begins
  EXPECT_EQ(stream.read(in).value(), 3U);
  EXPECT_EQ(in[0], 1);
}

// A writer that does not come back holds nobody up.
TEST(I2cStream, AWriterHasTheBusForOneTurnOnly) {
  const std::array<fake::I2cStep, 2> script = {{{kSent, {}, 1}, {kSent, {}, 0}}};
  Bus bus(script);
  I2cStream<Bus> stream(bus, 0x54);
  std::array<std::uint8_t, 16> in{};
  EXPECT_EQ(stream.read(in).error(), Error::kNotReady);
  EXPECT_EQ(stream.write(kSent).error(), Error::kFull);
  EXPECT_EQ(stream.read(in).value(), 3U);
  EXPECT_EQ(stream.read(in).error(), Error::kNotReady);  // the writer's turn
  EXPECT_EQ(stream.read(in).error(), Error::kNotReady);  // begins
  EXPECT_EQ(stream.read(in).value(), 3U);
}

TEST(I2cStream, LongWritesAreCut) {
  Bus bus({});
  I2cStream<Bus> stream(bus, 0x54);
  const std::array<std::uint8_t, 39> out{};
  EXPECT_EQ(stream.write(out).value(), 16U);
}

TEST(I2cStream, NobodyThereIsNotReadyNoBusIsGone) {
  Bus bus({});
  I2cStream<Bus> stream(bus, 0x54);
  std::array<std::uint8_t, 16> in{};
  for (int i = 0; i < 6; ++i) EXPECT_EQ(stream.read(in).error(), Error::kNotReady);
  bus.unplug();
  EXPECT_EQ(stream.read(in).error(), Error::kGone);
  EXPECT_EQ(stream.write(kSent).error(), Error::kGone);
  bus.replug();
  EXPECT_EQ(stream.write(kSent).value(), 3U);
}

TEST(I2cStream, ABusThatGoesWithinATransfer) {
  for (const bool writing : {true, false}) {
    const std::array<fake::I2cStep, 1> script = {{{kSent, {}, 5}}};
    Bus bus(script);
    I2cStream<Bus> stream(bus, 0x54);
    std::array<std::uint8_t, 16> in{};
    EXPECT_EQ(stream.read(in).error(), Error::kNotReady);
    bus.unplug();
    EXPECT_EQ(writing ? stream.write(kSent).error() : stream.read(in).error(), Error::kGone);
  }
}

struct TakenBus {
  static base::Result<std::size_t> begin(std::uint8_t /*address*/, std::span<const std::uint8_t> /*out*/,
                                         std::size_t /*expected*/) {
    return Error::kFull;
  }
  static base::Result<std::size_t> finish(std::span<std::uint8_t> /*in*/) { return Error::kNotReady; }
};

TEST(I2cStream, ABusThatAnotherHasIsNotReady) {
  TakenBus bus;
  I2cStream<TakenBus> stream(bus, 0x54);
  std::array<std::uint8_t, 16> in{};
  EXPECT_EQ(stream.read(in).error(), Error::kNotReady);
  EXPECT_EQ(stream.write(kSent).error(), Error::kFull);
}

}  // namespace
}  // namespace fencepost::wire
