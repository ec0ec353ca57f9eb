// I2C through the brick, and the NXTCam's driver on it, unchanged.
#include "drivers/nxt/sensor_port.hpp"

#include <gtest/gtest.h>

#include "tests/drivers/bench/nxt_rig.hpp"
#include "tests/drivers/hex.hpp"

namespace fencepost::nxt {
namespace {

using base::Error;
using test::hex;

struct SensorBench : test::Bench<test::NxtBrickRig<test::UsbBrick>> {
  emulate::NxtCam camera_device{base::Time{}};
  SensorPort port{brick.conversation(), 0};

  void attach() { device.attach(0, &camera_device); }
  // The answer to a transfer, within 2 s.
  base::Result<std::size_t> transfer(std::uint8_t address, const std::vector<std::uint8_t>& out, std::size_t expected,
                                     std::span<std::uint8_t> in) {
    const auto begun = port.begin(address, out, expected);
    if (!begun) return begun;
    for (int ms = 0; ms < 2'000; ++ms) {
      run(1);
      const auto got = port.finish(in);
      if (got || got.error() != Error::kNotReady) return got;
    }
    return Error::kNotReady;
  }
};

struct NxtSensorPort : testing::Test {
  NxtSensorPort() { bench.attach(); }
  SensorBench bench;
};

TEST_F(NxtSensorPort, ReadsRegisters) {
  bench.run(4'000);
  std::array<std::uint8_t, 16> in{};
  EXPECT_EQ(bench.port.finish(in).error(), Error::kNotReady);
  ASSERT_EQ(bench.transfer(0x01, hex("08"), 16, in).value(), 16U);
  EXPECT_EQ(std::string(in.begin(), in.begin() + 14), "mndsnsrsNXTCam");
  EXPECT_EQ(bench.transfer(0x01, hex("41 45"), 0, in).value(), 0U);
  EXPECT_TRUE(bench.camera_device.tracking());
}

TEST_F(NxtSensorPort, NobodyAtTheAddressIsRefusedAndTheBusFree) {
  bench.run(4'000);
  std::array<std::uint8_t, 16> in{};
  EXPECT_EQ(bench.transfer(0x05, hex("08"), 8, in).error(), Error::kRefused);
  EXPECT_EQ(bench.transfer(0x01, hex("10"), 8, in).value(), 8U);
  EXPECT_EQ(in[0], 'N');
}

TEST_F(NxtSensorPort, LimitsAndOverlap) {
  bench.run(4'000);
  const std::array<std::uint8_t, 16> sixteen{};
  EXPECT_EQ(bench.port.begin(1, sixteen, 0).error(), Error::kFull);
  EXPECT_EQ(bench.port.begin(1, {}, 17).error(), Error::kFull);
  std::array<std::uint8_t, 16> in{};
  EXPECT_EQ(bench.transfer(1, hex("08"), 16, in).value(), 16U) << "the most it takes";
  EXPECT_EQ(bench.transfer(1, std::vector<std::uint8_t>(15, 0x41), 0, in).value(), 0U);
  EXPECT_TRUE(bench.port.begin(1, hex("08"), 8));
  EXPECT_EQ(bench.port.begin(1, hex("08"), 8).error(), Error::kFull);
}

TEST_F(NxtSensorPort, AnUnpluggedBrickHasNoBus) {
  bench.run(4'000);
  std::array<std::uint8_t, 16> in{};
  EXPECT_TRUE(bench.port.begin(1, hex("08"), 8));
  (void)bench.port.finish(in);
  bench.link.unplug();
  bench.run(3);
  EXPECT_EQ(bench.port.finish(in).error(), Error::kGone);
  EXPECT_EQ(bench.port.begin(1, hex("08"), 8).error(), Error::kGone);
  bench.link.replug();
  bench.run(1'000);
  EXPECT_EQ(bench.transfer(0x01, hex("10"), 8, in).value(), 8U);
}

// After a restart the port is an ordinary one again: the first transfer says so, the next sets it up.
TEST_F(NxtSensorPort, IsSetUpAgainAfterARestart) {
  bench.run(4'000);
  std::array<std::uint8_t, 16> in{};
  EXPECT_EQ(bench.transfer(0x01, hex("10"), 8, in).value(), 8U);
  bench.device.restart(bench.clock.now());
  bench.run(10'000);
  EXPECT_EQ(bench.transfer(0x01, hex("10"), 8, in).error(), Error::kRefused);
  EXPECT_EQ(bench.transfer(0x01, hex("10"), 8, in).value(), 8U);
}

}  // namespace
}  // namespace fencepost::nxt
