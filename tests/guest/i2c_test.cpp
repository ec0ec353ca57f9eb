// hal/linux/i2c.hpp on the kernel's own i2c-dev, over an i2c-tiny-usb adapter made of software.
#include "hal/linux/i2c.hpp"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <mutex>
#include <numeric>
#include <utility>

#include "hal/linux/wait.hpp"
#include "tests/guest/eventually.hpp"
#include "tests/guest/i2c_adapter.hpp"

namespace fencepost::guest {
namespace {

using base::Error;
using base::Result;
using linux::I2c;
using linux::Opened;

constexpr std::uint8_t kDevice = 0x01;  // where an NXTCam is, and many tools refuse to look

/// A memory of 256 registers with an address pointer, on a bus of its own.
class Memory {
 public:
  Memory() { std::iota(registers_.begin(), registers_.end(), std::uint8_t{0}); }
  std::optional<Bytes> answer(const I2cMessage& message) {
    const std::lock_guard lock(mutex_);
    bus_ += 'S';
    const bool mine = message.address == kDevice;
    const std::string what = message.reading ? "R" + std::to_string(message.length) : "W" + size_of(message);
    bus_ += mine ? what : "N";
    if (message.last) bus_ += 'P';
    if (!mine) return std::nullopt;
    Bytes in(message.length);
    for (std::uint8_t& byte : in) byte = registers_[pointer_++];
    if (!message.out.empty()) pointer_ = message.out[0];
    for (std::size_t i = 1; i < message.out.size(); ++i) registers_[pointer_++] = message.out[i];
    return in;
  }
  std::uint8_t reg(std::uint8_t index) {
    const std::lock_guard lock(mutex_);
    return registers_[index];
  }
  /// The events on the bus since the last call: S start, W and R with their lengths, P stop, N nobody acknowledged.
  std::string take_log() {
    const std::lock_guard lock(mutex_);
    return std::exchange(bus_, {});
  }

 private:
  static std::string size_of(const I2cMessage& message) { return std::to_string(message.out.size()); }

  std::mutex mutex_;  // messages come on the adapter's own thread
  std::array<std::uint8_t, 256> registers_{};
  std::string bus_;
  std::uint8_t pointer_ = 0;
};

class I2cTest : public testing::Test {
 protected:
  void SetUp() override {
    path = adapter.path();
    ASSERT_FALSE(path.empty()) << "the kernel made no I2C adapter";
    Opened<I2c> opened = I2c::open({path});
    ASSERT_TRUE(opened) << opened.problem();
    i2c.emplace(std::move(*opened));
    static_cast<void>(memory.take_log());
  }
  void TearDown() override { i2c.reset(); }

  Result<Bytes> transfer(std::uint8_t address, const Bytes& out, std::size_t expected) {
    const Result<std::size_t> begun = i2c->begin(address, out, expected);
    if (!begun) return begun.error();
    EXPECT_EQ(*begun, out.size());
    Bytes in(expected);
    const Result<std::size_t> count = settled([&] { return i2c->finish(in); });
    if (!count) return count.error();
    in.resize(*count);
    return in;
  }

  const linux::MonotonicClock clock;
  Memory memory;
  I2cAdapter adapter{[this](const I2cMessage& message) { return memory.answer(message); }};
  std::string path;
  std::optional<I2c> i2c;
};

TEST_F(I2cTest, ReadsARegisterAfterARepeatedStart) {
  const Result<Bytes> in = transfer(kDevice, {0x42}, 3);
  ASSERT_TRUE(in) << static_cast<int>(in.error());
  EXPECT_EQ(*in, (Bytes{0x42, 0x43, 0x44}));
  EXPECT_EQ(memory.take_log(), "SW1SR3P") << "no stop between writing and reading";
}

TEST_F(I2cTest, WritesWithoutReading) {
  const Result<Bytes> in = transfer(kDevice, {0x41, 0xAA, 0xBB}, 0);
  ASSERT_TRUE(in);
  EXPECT_TRUE(in->empty());
  EXPECT_EQ(memory.reg(0x41), 0xAA);
  EXPECT_EQ(memory.reg(0x42), 0xBB);
  EXPECT_EQ(memory.take_log(), "SW3P");
}

TEST_F(I2cTest, ReadsWithoutWriting) {
  ASSERT_TRUE(transfer(kDevice, {0x10}, 0));
  EXPECT_EQ(*transfer(kDevice, {}, 2), (Bytes{0x10, 0x11}));
}

TEST_F(I2cTest, TakesTheLongestTransferAndNothingLonger) {
  const Result<Bytes> in = transfer(kDevice, {0x80}, bus::kMaxI2cTransfer);
  ASSERT_TRUE(in);
  EXPECT_EQ(in->size(), bus::kMaxI2cTransfer);
  EXPECT_EQ(in->back(), 0x80 + bus::kMaxI2cTransfer - 1);
  EXPECT_EQ(transfer(kDevice, {0}, bus::kMaxI2cTransfer + 1).error(), Error::kFull);
  EXPECT_EQ(transfer(kDevice, Bytes(bus::kMaxI2cTransfer + 1), 0).error(), Error::kFull);
}

TEST_F(I2cTest, IsRefusedWhereNobodyAcknowledges) {
  EXPECT_EQ(transfer(0x50, {0}, 1).error(), Error::kRefused);
  EXPECT_TRUE(i2c->connected());
  EXPECT_TRUE(transfer(kDevice, {0}, 1)) << "the bus is free again";
}

TEST_F(I2cTest, NeverWaitsForASlowBus) {
  linux::WaitSet set;
  set.add_readable(i2c->descriptor());
  adapter.wire().hold(true);
  const Bytes out = {0x42};
  ASSERT_TRUE(i2c->begin(kDevice, out, 1));
  std::array<std::uint8_t, 1> in{};
  EXPECT_EQ(i2c->finish(in).error(), Error::kNotReady);
  EXPECT_EQ(i2c->begin(kDevice, out, 1).error(), Error::kFull);
  EXPECT_FALSE(set.wait_until(clock, clock.now() + base::milliseconds(50)));
  adapter.wire().hold(false);
  EXPECT_TRUE(set.wait_until(clock, clock.now() + kPatience));
  EXPECT_EQ(i2c->finish(in).value(), 1U);
  EXPECT_EQ(in[0], 0x42);
  EXPECT_EQ(i2c->finish(in).error(), Error::kNotReady) << "each transfer ends once";
  EXPECT_FALSE(set.wait_until(clock, clock.now()));
}

TEST_F(I2cTest, IsGoneWithItsAdapterAndComesBackWithIt) {
  adapter.wire().unplug();
  const Bytes out = {0};
  std::array<std::uint8_t, 1> in{};
  // Until the kernel has noticed, it looks as if nobody acknowledged.
  EXPECT_TRUE(eventually([&] {
    if (!i2c->begin(kDevice, out, 1)) return true;
    const Result<std::size_t> answer = settled([&] { return i2c->finish(in); });
    return !answer && answer.error() == Error::kGone;
  }));
  EXPECT_EQ(i2c->begin(kDevice, out, 1).error(), Error::kGone);
  EXPECT_EQ(i2c->finish(in).error(), Error::kGone);
  EXPECT_FALSE(i2c->connected());
  i2c->tend(clock.now());
  EXPECT_NE(i2c->problem().find(path), std::string::npos) << i2c->problem();
  ASSERT_TRUE(eventually([this] { return !std::filesystem::exists(path); }));
  adapter.wire().plug();
  ASSERT_EQ(adapter.path(), path);
  ASSERT_TRUE(eventually([this] {
    i2c->tend(clock.now());
    return i2c->connected();
  })) << i2c->problem();
  EXPECT_EQ(*transfer(kDevice, {0x42}, 1), Bytes{0x42});
}

}  // namespace
}  // namespace fencepost::guest
