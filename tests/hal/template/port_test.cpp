// The empty port compiles, models each concept, and reports that no hardware is there.
#include <gtest/gtest.h>

#include <array>

#include "hal/template/can_controller.hpp"
#include "hal/template/clock.hpp"
#include "hal/template/i2c_master.hpp"
#include "hal/template/uart.hpp"
#include "hal/template/usb_host.hpp"

namespace fencepost::port {
namespace {

using base::Error;

TEST(TemplatePort, HasASerialLineOnWhichNothingComesAndNothingFits) {
  Uart uart(115'200);
  std::array<std::uint8_t, 4> bytes{};
  EXPECT_EQ(uart.baud(), 115'200U);
  EXPECT_EQ(uart.read(bytes).error(), Error::kNotReady);
  EXPECT_EQ(uart.write(bytes).error(), Error::kFull);
  EXPECT_EQ(uart.read({}).value(), 0U);
  EXPECT_EQ(uart.write({}).value(), 0U);
}

TEST(TemplatePort, HasBusesThatAreNotThere) {
  std::array<std::uint8_t, 4> bytes{};
  I2cMaster i2c;
  EXPECT_EQ(i2c.begin(0x01, bytes, 4).error(), Error::kGone);
  EXPECT_EQ(i2c.finish(bytes).error(), Error::kGone);
  UsbHost usb;
  EXPECT_EQ(usb.send(bytes).error(), Error::kGone);
  EXPECT_EQ(usb.receive(bytes).error(), Error::kGone);
  EXPECT_EQ(CanController().receive().error(), Error::kNotReady);
}

TEST(TemplatePort, HasAClockThatDoesNotGoBack) {
  const BoardClock clock;
  const base::Time first = clock.now();
  EXPECT_GE(clock.now(), first);
}

}  // namespace
}  // namespace fencepost::port
