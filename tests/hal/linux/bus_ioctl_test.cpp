// The requests of SPI and I2C to the kernel, and their use of its answers; tests/guest asks a kernel itself.
#include <gtest/gtest.h>
#include <linux/i2c-dev.h>
#include <linux/i2c.h>
#include <linux/spi/spidev.h>

#include <atomic>
#include <cerrno>
#include <filesystem>
#include <numeric>
#include <thread>
#include <vector>

#include "hal/linux/i2c.hpp"
#include "hal/linux/spi.hpp"
#include "tests/folder.hpp"
#include "tests/hal/linux/fake_ioctl.hpp"

namespace fencepost::linux {
namespace {

using base::Error;
using base::milliseconds;
using base::Time;
using test::FakeIoctl;
using Octets = std::vector<std::uint8_t>;

testing::AssertionResult contains(const std::string& text, std::string_view part) {
  if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << '"' << text << "\" lacks \"" << part << '"';
}

/// A node that is there, and can go.
class Node {
 public:
  Node() { plug(); }
  void plug() const { std::filesystem::create_symlink("/dev/null", path); }
  void unplug() const { std::filesystem::remove(path); }

 private:
  test::Folder folder_;

 public:
  std::string path = folder_.file("bus");
};

/// Answers 1, 2, 3 ... on SPI.
struct SpiDevice {
  std::optional<int> operator()(unsigned long request, void* argument) {
    if (request == failing) return -error;
    if (request == SPI_IOC_WR_MODE) mode = *static_cast<const std::uint8_t*>(argument);
    if (request == SPI_IOC_WR_BITS_PER_WORD) bits = *static_cast<const std::uint8_t*>(argument);
    if (request == SPI_IOC_WR_MAX_SPEED_HZ) hertz = *static_cast<const std::uint32_t*>(argument);
    if (request != SPI_IOC_MESSAGE(1)) return 0;
    const auto& both = *static_cast<const spi_ioc_transfer*>(argument);
    const auto* tx = reinterpret_cast<const std::uint8_t*>(static_cast<std::uintptr_t>(both.tx_buf));  // NOLINT
    auto* rx = reinterpret_cast<std::uint8_t*>(static_cast<std::uintptr_t>(both.rx_buf));              // NOLINT
    heard.assign(tx, tx + both.len);
    std::iota(rx, rx + both.len, next);
    next = static_cast<std::uint8_t>(next + both.len);
    speed = both.speed_hz;
    return static_cast<int>(both.len);
  }
  unsigned long failing = 0;
  int error = EIO;
  int mode = -1;
  int bits = -1;
  std::uint32_t hertz = 0;
  std::uint32_t speed = 0;
  std::uint8_t next = 1;
  Octets heard;
};

class SpiIoctl : public testing::Test {
 protected:
  std::string problem() {
    const Opened<Spi> spi = Spi::open({node.path});
    return spi ? "none" : spi.problem();
  }
  Node node;
  SpiDevice device;
  FakeIoctl fake{[this](unsigned long request, void* argument) { return device(request, argument); }};
};

TEST_F(SpiIoctl, KeepsWhatCameInWhileBytesWentOut) {
  Opened<Spi> spi = Spi::open({.path = node.path, .hertz = 500'000, .mode = 1});
  ASSERT_TRUE(spi) << spi.problem();
  EXPECT_EQ(device.mode, 1);
  EXPECT_EQ(device.bits, 8);
  EXPECT_EQ(device.hertz, 500'000U);
  EXPECT_EQ(spi->write(Octets{7, 8, 9}).value(), 3U);
  EXPECT_EQ(device.heard, (Octets{7, 8, 9}));
  EXPECT_EQ(device.speed, 500'000U);
  std::array<std::uint8_t, 100> in{};
  ASSERT_EQ(spi->read(in).value(), 3U);
  EXPECT_EQ(Octets(in.begin(), in.begin() + 3), (Octets{1, 2, 3}));
  EXPECT_EQ(spi->read(in).error(), Error::kNotReady) << "nothing was granted";
}

TEST_F(SpiIoctl, ClocksZerosOutWithinWhatIsGranted) {
  Opened<Spi> spi = Spi::open({node.path});
  ASSERT_TRUE(spi) << spi.problem();
  std::array<std::uint8_t, 100> in{};
  spi->tend(Time{} + milliseconds(5));
  ASSERT_EQ(spi->read(in).value(), 64U);
  EXPECT_EQ(in[63], 64);
  EXPECT_EQ(device.heard, Octets(64));
  EXPECT_EQ(spi->read(in).error(), Error::kNotReady);
  spi->tend(Time{} + milliseconds(5) + base::Duration{9});
  EXPECT_EQ(spi->read(in).error(), Error::kNotReady) << "a millisecond is not over";
  spi->tend(Time{} + milliseconds(6));
  EXPECT_EQ(spi->read({in.data(), 2}).value(), 2U);
  EXPECT_EQ(in[0], 65);
}

TEST_F(SpiIoctl, TakesNoMoreThanItCanKeepOfTheAnswer) {
  Opened<Spi> spi = Spi::open({node.path});
  ASSERT_TRUE(spi) << spi.problem();
  EXPECT_EQ(spi->write(Octets(70, 5)).value(), 64U);
  EXPECT_EQ(spi->write(Octets{5}).error(), Error::kFull);
  std::array<std::uint8_t, 2> in{};
  EXPECT_EQ(spi->read(in).value(), 2U);
  EXPECT_EQ(spi->write(Octets(70, 5)).value(), 2U);
}

TEST_F(SpiIoctl, IsGoneWhereTheKernelTakesTheBusAway) {
  Opened<Spi> spi = Spi::open({node.path});
  ASSERT_TRUE(spi) << spi.problem();
  ASSERT_TRUE(spi->write(Octets{1, 2}).ok());
  device.failing = SPI_IOC_MESSAGE(1);
  EXPECT_EQ(spi->write(Octets{1}).error(), Error::kGone);
  EXPECT_FALSE(spi->connected());
  std::array<std::uint8_t, 4> in{};
  EXPECT_EQ(spi->read(in).error(), Error::kGone);
  EXPECT_EQ(spi->write(in).error(), Error::kGone);

  device.failing = 0;
  node.unplug();
  const Time now = Time{} + milliseconds(1000);
  spi->tend(now);
  EXPECT_TRUE(contains(spi->problem(), "cannot open the SPI device " + node.path));
  node.plug();
  spi->tend(now + milliseconds(249));
  EXPECT_FALSE(spi->connected());
  spi->tend(now + milliseconds(250));
  ASSERT_TRUE(spi->connected()) << spi->problem();
  EXPECT_EQ(spi->problem(), "");
  ASSERT_EQ(spi->read(in).value(), 4U);
  EXPECT_EQ(in[0], 3) << "what was kept before it was gone is forgotten";
  device.failing = SPI_IOC_MESSAGE(1);
  spi->tend(now + milliseconds(260));
  EXPECT_EQ(spi->read(in).error(), Error::kGone);
  EXPECT_FALSE(spi->connected());
}

TEST_F(SpiIoctl, SaysWhatTheKernelRefusesAndWhatToTry) {
  device.failing = SPI_IOC_WR_MODE;
  EXPECT_TRUE(contains(problem(), "choose another mode or a slower clock"));
  device.failing = SPI_IOC_WR_MAX_SPEED_HZ;
  EXPECT_TRUE(contains(problem(), "choose another mode or a slower clock"));
  device.failing = SPI_IOC_WR_BITS_PER_WORD;
  EXPECT_TRUE(contains(problem(), "look at the end of 'dmesg'"));
  device.error = EACCES;
  EXPECT_TRUE(contains(problem(), "sudo usermod -aG spi $USER"));
}

/// One message of a transfer, as the kernel gets it.
struct Message {
  int address;
  bool read;
  Octets bytes;
  friend bool operator==(const Message&, const Message&) = default;
};

/// Answers reads with 10, 11, 12 ...
struct I2cDevice {
  std::optional<int> operator()(unsigned long request, void* argument) {
    if (request == I2C_FUNCS) return *static_cast<unsigned long*>(argument) = functions, 0;
    if (request == I2C_TIMEOUT) {
      steps = reinterpret_cast<std::uintptr_t>(argument);  // NOLINT: a number
      return -timeout_error;
    }
    while (busy) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (interrupted.exchange(false)) return -EINTR;
    if (error != 0) return -error;
    const auto& all = *static_cast<const i2c_rdwr_ioctl_data*>(argument);
    messages.clear();
    for (std::uint32_t i = 0; i < all.nmsgs; ++i) {
      const i2c_msg& one = all.msgs[i];
      const bool read = (one.flags & I2C_M_RD) != 0;
      if (read) std::iota(one.buf, one.buf + one.len, std::uint8_t{10});
      messages.push_back({one.addr, read, Octets(one.buf, one.buf + one.len)});
    }
    return static_cast<int>(all.nmsgs);
  }
  unsigned long functions = I2C_FUNC_I2C;
  std::uintptr_t steps = 0;
  int timeout_error = 0;
  std::atomic<bool> busy = false;
  std::atomic<bool> interrupted = false;
  std::atomic<int> error = 0;
  std::vector<Message> messages;
};

class I2cIoctl : public testing::Test {
 protected:
  std::string problem() {
    const Opened<I2c> bus = I2c::open({node.path});
    return bus ? "none" : bus.problem();
  }
  static base::Result<std::size_t> end(I2c& bus, std::span<std::uint8_t> in) {
    base::Result<std::size_t> answer = Error::kNotReady;
    for (int i = 0; i < 10'000; ++i) {
      answer = bus.finish(in);
      if (answer || answer.error() != Error::kNotReady) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return answer;
  }
  Node node;
  I2cDevice device;
  FakeIoctl fake{[this](unsigned long request, void* argument) { return device(request, argument); }};
  std::array<std::uint8_t, 4> in{};
};

TEST_F(I2cIoctl, WritesAndReadsWithoutAStopBetween) {
  Opened<I2c> bus = I2c::open({node.path, std::chrono::milliseconds(101)});
  ASSERT_TRUE(bus) << bus.problem();
  EXPECT_EQ(device.steps, 11U) << "of 10 ms, rounded up";
  EXPECT_GE(bus->descriptor(), 0);
  EXPECT_EQ(bus->finish(in).error(), Error::kNotReady) << "nothing was begun";
  EXPECT_EQ(bus->begin(0x54, Octets{1, 2}, 3).value(), 2U);
  EXPECT_EQ(end(*bus, in).value(), 3U);
  EXPECT_EQ(in, (std::array<std::uint8_t, 4>{10, 11, 12, 0}));
  EXPECT_EQ(device.messages, (std::vector<Message>{{0x54, false, {1, 2}}, {0x54, true, {10, 11, 12}}}));

  ASSERT_TRUE(bus->begin(0x54, {}, 3).ok());
  EXPECT_EQ(end(*bus, {in.data(), 2}).value(), 2U) << "no more than there is room for";
  EXPECT_EQ(device.messages, (std::vector<Message>{{0x54, true, {10, 11, 12}}}));
  ASSERT_TRUE(bus->begin(0x17, {}, 0).ok());
  EXPECT_EQ(end(*bus, in).value(), 0U);
  EXPECT_EQ(device.messages, (std::vector<Message>{{0x17, false, {}}})) << "an address alone asks who is there";
}

TEST_F(I2cIoctl, IsForOneTransferAtATime) {
  Opened<I2c> bus = I2c::open({node.path});
  ASSERT_TRUE(bus) << bus.problem();
  EXPECT_EQ(bus->begin(0x54, Octets(bus::kMaxI2cTransfer + 1), 0).error(), Error::kFull);
  EXPECT_EQ(bus->begin(0x54, {}, bus::kMaxI2cTransfer + 1).error(), Error::kFull);
  device.busy = true;
  ASSERT_TRUE(bus->begin(0x54, Octets{1}, 1).ok());
  EXPECT_EQ(bus->begin(0x54, Octets{2}, 1).error(), Error::kFull);
  EXPECT_EQ(bus->finish(in).error(), Error::kNotReady);
  device.busy = false;
  EXPECT_EQ(end(*bus, in).value(), 1U);
  I2c moved = std::move(*bus);
  device.interrupted = true;
  ASSERT_TRUE(moved.begin(0x54, Octets{3}, 0).ok());
  EXPECT_EQ(end(moved, in).value(), 0U) << "a signal is no failure";
  EXPECT_EQ(device.messages, (std::vector<Message>{{0x54, false, {3}}}));
}

TEST_F(I2cIoctl, TellsARefusalFromAnUnplug) {
  Opened<I2c> bus = I2c::open({node.path});
  ASSERT_TRUE(bus) << bus.problem();
  device.error = ENXIO;
  ASSERT_TRUE(bus->begin(0x54, Octets{1}, 1).ok());
  EXPECT_EQ(end(*bus, in).error(), Error::kRefused);
  EXPECT_TRUE(bus->connected());
  node.unplug();
  ASSERT_TRUE(bus->begin(0x54, Octets{1}, 1).ok());
  EXPECT_EQ(end(*bus, in).error(), Error::kGone);
  EXPECT_FALSE(bus->connected());
  EXPECT_EQ(bus->begin(0x54, Octets{1}, 1).error(), Error::kGone);
  EXPECT_EQ(bus->finish(in).error(), Error::kGone);

  device.error = 0;
  const Time now = Time{} + milliseconds(1000);
  bus->tend(now);
  EXPECT_TRUE(contains(bus->problem(), "cannot open the I2C adapter " + node.path));
  node.plug();
  bus->tend(now + milliseconds(249));
  EXPECT_FALSE(bus->connected());
  bus->tend(now + milliseconds(250));
  ASSERT_TRUE(bus->connected()) << bus->problem();
  EXPECT_EQ(bus->problem(), "");
  ASSERT_TRUE(bus->begin(0x54, Octets{1}, 1).ok());
  EXPECT_EQ(end(*bus, in).value(), 1U);
}

TEST_F(I2cIoctl, SaysWhatTheAdapterLacksAndWhatToTry) {
  device.timeout_error = EIO;
  EXPECT_TRUE(contains(problem(), "look at the end of 'dmesg'"));
  device.timeout_error = EPERM;
  EXPECT_TRUE(contains(problem(), "sudo usermod -aG i2c $USER"));
  device.functions = I2C_FUNC_SMBUS_EMUL;
  EXPECT_TRUE(contains(problem(), "it speaks SMBus only"));
}

}  // namespace
}  // namespace fencepost::linux
