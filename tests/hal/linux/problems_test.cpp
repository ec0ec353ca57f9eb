// Messages about missing buses; data transfer is tested against a real kernel, in tests/guest.
#include <gtest/gtest.h>

#include <string>

#include "hal/linux/can.hpp"
#include "hal/linux/i2c.hpp"
#include "hal/linux/retry.hpp"
#include "hal/linux/spi.hpp"
#include "hal/linux/usb_link.hpp"
#include "tests/text.hpp"

namespace fencepost::linux {
namespace {

using base::milliseconds;
using base::Time;
using test::holds;

TEST(I2cProblem, NamesThePathAndWhatToTry) {
  Opened<I2c> bus = I2c::open({"/dev/i2c-250"});
  ASSERT_FALSE(bus);
  EXPECT_TRUE(holds(bus.problem(), "cannot open the I2C adapter /dev/i2c-250"));
  EXPECT_TRUE(holds(bus.problem(), "modprobe i2c-dev"));
}

TEST(I2cProblem, TellsAnotherDeviceFromAnAdapter) {
  for (const char* path : {"/dev/null", "/dev"}) {
    Opened<I2c> bus = I2c::open({path});
    ASSERT_FALSE(bus) << path;
    EXPECT_TRUE(holds(bus.problem(), "name an I2C adapter")) << path;
  }
}

TEST(SpiProblem, NamesThePathAndWhatToTry) {
  Opened<Spi> bus = Spi::open({"/dev/spidev9.9"});
  ASSERT_FALSE(bus);
  EXPECT_TRUE(holds(bus.problem(), "cannot open the SPI device /dev/spidev9.9"));
  EXPECT_TRUE(holds(bus.problem(), "enable SPI"));
}

TEST(SpiProblem, TellsAnotherDeviceFromABus) {
  for (const char* path : {"/dev/null", "/dev"}) {
    Opened<Spi> bus = Spi::open({path});
    ASSERT_FALSE(bus) << path;
    EXPECT_TRUE(holds(bus.problem(), "name an SPI device")) << path;
  }
}

TEST(SpiProblem, RefusesAModeThatDoesNotExist) {
  Opened<Spi> bus = Spi::open({.path = "/dev/null", .mode = 4});
  ASSERT_FALSE(bus);
  EXPECT_TRUE(holds(bus.problem(), "choose another mode"));
}

// A kernel without CAN and one without this interface give different reasons, both name it.
TEST(CanProblem, NamesTheInterfaceAndWhatToTry) {
  Opened<Can> bus = Can::open({"fencepost9", {}}, MonotonicClock());
  ASSERT_FALSE(bus);
  EXPECT_TRUE(holds(bus.problem(), "cannot listen on the CAN interface fencepost9"));
  EXPECT_TRUE(holds(bus.problem(), "; "));
}

// libusb itself may not start where there is no USB at all; the sentence is another one then.
TEST(UsbProblem, NamesTheDeviceAndWhatToTry) {
  Opened<UsbPacketLink> link = UsbPacketLink::open({.vendor = 0xFEED, .product = 0x00C0, .serial = "A1"});
  ASSERT_FALSE(link);
  const bool none_at_all = bool(holds(link.problem(), "cannot start libusb"));
  EXPECT_TRUE(none_at_all || holds(link.problem(), "cannot open the USB device feed:00c0 with serial number A1"));
  EXPECT_TRUE(holds(link.problem(), "; "));
}

TEST(Retry, ComesOnceAnInterval) {
  Retry retry;
  const Time start = Time{} + milliseconds(7);
  EXPECT_TRUE(retry.due(start));
  EXPECT_FALSE(retry.due(start));
  EXPECT_FALSE(retry.due(start + kRetryInterval - base::Duration{1}));
  EXPECT_TRUE(retry.due(start + kRetryInterval));
  EXPECT_FALSE(retry.due(start + kRetryInterval + base::Duration{1}));
  EXPECT_TRUE(retry.due(start)) << "a clock set back must not stop it for long";
}

}  // namespace
}  // namespace fencepost::linux
