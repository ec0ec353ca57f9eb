// The pins of boards with an RP2040 against what their makers say of them.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "hal/boards/pico/pins.hpp"
#include "hal/boards/xrp/pins.hpp"
#include "tests/hal/boards/rp2_uses.hpp"

namespace fencepost::test {
namespace {

using Faults = std::vector<std::string>;

Faults faults_of(const std::string& table, const board::Wiring& wiring) {
  return PinTable(table, "rp2040_functions").faults(uses_of(wiring));
}

TEST(Rp2040Pins, PicoHasItsPinsRight) { EXPECT_EQ(faults_of("pico", board::pico::kWiring), Faults{}); }
TEST(Rp2040Pins, XrpHasItsPinsRight) { EXPECT_EQ(faults_of("xrp", board::xrp::kWiring), Faults{}); }

// `status` names them.
TEST(Rp2040Pins, NamesItsPinsRight) {
  for (const board::Wiring& wiring : {board::pico::kWiring, board::xrp::kWiring}) {
    const std::string line = name(wiring.camera.transmit) + " sends, " + name(wiring.camera.receive) + " receives";
    EXPECT_EQ(wiring.names.line, line);
    EXPECT_EQ(wiring.names.base, line);
    EXPECT_EQ(wiring.names.two_wire, name(wiring.i2c.data) + " data, " + name(wiring.i2c.clock) + " clock");
  }
}

TEST(Rp2040Pins, TheDocumentHasThePinsOfTheXrp) {
  const PinTable table("xrp", "");
  for (const PinUse& use : uses_of(board::xrp::kWiring)) {
    const std::string header = table.header(use.pin);
    const std::string row = "| " + use.what + " | " + use.pin + ", " + (header.empty() ? use.meant : header) + " |";
    EXPECT_TRUE(document_has(row)) << row;
  }
}

TEST(Rp2040Pins, TheDocumentHasThePins) {
  const PinTable table("pico", "");
  for (const PinUse& use : uses_of(board::pico::kWiring)) {
    const std::string header = table.header(use.pin);
    std::string row = "| " + use.what + " | " + use.pin;
    row += header.empty() ? " |" : ", pin " + header + " |";
    EXPECT_TRUE(document_has(row)) << row;
  }
}

// Two motors of one slice and channel would be one, and the encoders' pins are taken.
TEST(Rp2040Pins, FindsAMotorAtAnotherOnesPin) {
  board::Wiring wiring = board::xrp::kWiring;
  wiring.left_motor.power = {3};
  wiring.right_motor.direction = mcu::rp2::Pin{12};
  const Faults expected = {"left motor: GP3 is motor 3, not left motor",
                           "right direction: GP12 is free, not right motor",
                           "right direction: GP12 is that of: right b"};
  EXPECT_EQ(faults_of("xrp", wiring), expected);
  EXPECT_NE(board::pico::kWiring.left_motor.power.number % 16, board::pico::kWiring.right_motor.power.number % 16);
}

TEST(Rp2040Pins, FindsAPinOfTheOtherBusAndOneThatIsNotThere) {
  board::Wiring wiring = board::pico::kWiring;
  wiring.i2c.data = {6};
  wiring.stop = {24};
  const Faults expected = {"bus data: function 3 of GP6 is I2C1_SDA, not I2C0_SDA", "stop: GP24 is USB VBUS",
                           "stop: GP24 is not on the header"};
  EXPECT_EQ(faults_of("pico", wiring), expected);
}

}  // namespace
}  // namespace fencepost::test
