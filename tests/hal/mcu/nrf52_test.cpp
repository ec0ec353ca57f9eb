// The nRF52833 port's decisions that can be tested on the desk; the rest runs in tests/boards/nrf5.
#include <gtest/gtest.h>

#include "firmware/config/devices.hpp"
#include "hal/mcu/nrf52/uart.hpp"

namespace fencepost::mcu::nrf52 {
namespace {

// The part divides 16 MHz by a whole number: the vendor's file names what comes of each value (UARTE, BAUDRATE). Half a
// bit in ten is where a receiver loses the last one.
void expect_speed(std::uint32_t baud, const std::string& name) {
  const std::uint64_t divider = (std::uint64_t{1} << 32) / line_setting(baud);
  EXPECT_NEAR(16e6 / static_cast<double>(divider) / baud, 1.0, 0.025) << name;
}

TEST(Nrf52, HasTheSpeedOfEachCameraAndBaseOfALine) {
  for (const config::DeviceInfo& camera : config::kCameras) {
    if (camera.port == config::Port::kLine) expect_speed(camera.speed, std::string(camera.name));
  }
  for (const config::DeviceInfo& base : config::kOdometries) {
    if (base.port == config::Port::kLine) expect_speed(base.speed, std::string(base.name));
  }
  EXPECT_EQ(line_setting(115'200), kLineBaud115200);
  EXPECT_EQ(line_setting(1'000'000), kLineBaud921600) << "the next one";
}

}  // namespace
}  // namespace fencepost::mcu::nrf52
