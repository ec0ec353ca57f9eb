// hal/linux/i2c.hpp on the kernel's own i2c-dev, over an i2c-tiny-usb adapter made of software.
#include "hal/linux/i2c.hpp"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <memory>
#include <mutex>
#include <numeric>
#include <utility>

#include "hal/linux/wait.hpp"
#include "tests/guest/eventually.hpp"
#include "tests/guest/usbip_device.hpp"

namespace fencepost::guest {
namespace {

using base::Error;
using base::Result;
using linux::I2c;
using linux::Opened;

constexpr std::uint8_t kDevice = 0x01;  // where an NXTCam is, and many tools refuse to look

/// A memory of 256 registers with an address pointer, on a bus of its own. Requests of the adapter: i2c-tiny-usb.c of
/// the Linux kernel.
class Adapter {
 public:
  Adapter() : device_(model()) {
    std::iota(registers_.begin(), registers_.end(), std::uint8_t{0});
    eventually([] { return node().empty(); });  // the last test's adapter may be there for another moment
    device_.plug();
  }
  /// Its node, once the kernel has made it; empty if it never does.
  static std::string path() {
    std::string found;
    eventually([&found] {
      found = node();
      return !found.empty() && std::filesystem::exists(found);
    });
    return found;
  }
  static std::string node() {
    for (const auto& entry : std::filesystem::directory_iterator("/sys/bus/i2c/devices")) {
      std::string name;
      std::getline(std::ifstream(entry.path() / "name"), name);
      if (name.rfind("i2c-tiny-usb", 0) == 0) return "/dev/" + entry.path().filename().string();
    }
    return {};
  }
  UsbipDevice& wire() { return device_; }

  std::uint8_t reg(std::uint8_t index) {
    const std::lock_guard lock(mutex_);
    return registers_[index];
  }
  /// What happened on the bus since it was last asked: S start, W and R with their lengths, P stop, N nobody
  /// acknowledged.
  std::string take_log() {
    const std::lock_guard lock(mutex_);
    return std::exchange(bus_, {});
  }

 private:
  UsbModel model() {
    UsbModel model;
    model.vendor = 0x0403;
    model.product = 0xC631;
    model.strings = {"Till Harbaum", "i2c-tiny-usb", "1"};
    model.interface_descriptors = {9, 4, 0, 0, 0, 0xFF, 0, 0, 0};
    model.on_control = [this](const UsbSetup& setup, const Bytes& out) { return request(setup, out); };
    return model;
  }
  std::optional<Bytes> request(const UsbSetup& setup, const Bytes& out) {
    enum : std::uint8_t { kEcho = 0, kFunctions = 1, kDelay = 2, kStatus = 3, kTransfer = 4, kLast = 7 };
    switch (setup.request) {
      case kEcho: return Bytes{static_cast<std::uint8_t>(setup.value), static_cast<std::uint8_t>(setup.value >> 8)};
      case kFunctions: return Bytes{0x01, 0x00, 0xFF, 0x0E};  // I2C_FUNC_I2C and what SMBus can do by it
      case kDelay: return Bytes();
      case kStatus: return Bytes{acknowledged_ ? std::uint8_t{1} : std::uint8_t{2}};
      default: break;
    }
    if (setup.request > kLast) return std::nullopt;
    return transfer(setup, out);
  }
  Bytes transfer(const UsbSetup& setup, const Bytes& out) {
    const std::lock_guard lock(mutex_);
    constexpr std::uint8_t kStart = 1;
    constexpr std::uint8_t kStop = 2;
    const bool reading = (setup.type & 0x80U) != 0;
    if ((setup.request & kStart) != 0 || reading) bus_ += 'S';
    acknowledged_ = setup.index == kDevice;
    if (!acknowledged_) bus_ += 'N';
    if (acknowledged_) bus_ += (reading ? "R" : "W") + std::to_string(setup.length);
    Bytes in(reading ? setup.length : 0U);
    if (acknowledged_ && reading) {
      for (std::uint8_t& byte : in) byte = registers_[pointer_++];
    }
    if (acknowledged_ && !out.empty()) pointer_ = out[0];
    for (std::size_t i = 1; acknowledged_ && i < out.size(); ++i) registers_[pointer_++] = out[i];
    if ((setup.request & kStop) != 0) bus_ += 'P';
    return in;
  }

  std::mutex mutex_;  // requests come on the device's own thread
  std::array<std::uint8_t, 256> registers_{};
  std::string bus_;
  bool acknowledged_ = true;
  std::uint8_t pointer_ = 0;
  UsbipDevice device_;
};

class I2cTest : public testing::Test {
 protected:
  void SetUp() override {
    path = adapter.path();
    ASSERT_FALSE(path.empty()) << "the kernel made no I2C adapter";
    Opened<I2c> opened = I2c::open({path});
    ASSERT_TRUE(opened) << opened.problem();
    i2c.emplace(std::move(*opened));
    static_cast<void>(adapter.take_log());
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
  Adapter adapter;
  std::string path;
  std::optional<I2c> i2c;
};

TEST_F(I2cTest, ReadsARegisterAfterARepeatedStart) {
  const Result<Bytes> in = transfer(kDevice, {0x42}, 3);
  ASSERT_TRUE(in) << static_cast<int>(in.error());
  EXPECT_EQ(*in, (Bytes{0x42, 0x43, 0x44}));
  EXPECT_EQ(adapter.take_log(), "SW1SR3P") << "no stop between writing and reading";
}

TEST_F(I2cTest, WritesWithoutReading) {
  const Result<Bytes> in = transfer(kDevice, {0x41, 0xAA, 0xBB}, 0);
  ASSERT_TRUE(in);
  EXPECT_TRUE(in->empty());
  EXPECT_EQ(adapter.reg(0x41), 0xAA);
  EXPECT_EQ(adapter.reg(0x42), 0xBB);
  EXPECT_EQ(adapter.take_log(), "SW3P");
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
