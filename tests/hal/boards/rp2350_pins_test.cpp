// The pins of boards with an RP2350 against what their makers say of them.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "hal/boards/pico2/pins.hpp"
#include "hal/boards/xrp2/pins.hpp"
#include "tests/hal/boards/rp2_uses.hpp"

namespace fencepost::test {
namespace {

using Faults = std::vector<std::string>;

Faults faults_of(const std::string& table, const board::Wiring& wiring) {
  return PinTable(table, "rp2350_functions").faults(uses_of(wiring));
}

TEST(Rp2350Pins, Pico2HasItsPinsRight) { EXPECT_EQ(faults_of("pico2", board::pico2::kWiring), Faults{}); }
TEST(Rp2350Pins, Xrp2HasItsPinsRight) { EXPECT_EQ(faults_of("xrp2", board::xrp2::kWiring), Faults{}); }

// `status` names them.
TEST(Rp2350Pins, NamesItsPinsRight) {
  for (const board::Wiring& wiring : {board::pico2::kWiring, board::xrp2::kWiring}) {
    const std::string line = name(wiring.camera.transmit) + " sends, " + name(wiring.camera.receive) + " receives";
    EXPECT_EQ(wiring.names.line, line);
    EXPECT_EQ(wiring.names.base, line);
    EXPECT_EQ(wiring.names.two_wire, name(wiring.i2c.data) + " data, " + name(wiring.i2c.clock) + " clock");
  }
}

TEST(Rp2350Pins, TheDocumentHasThePins) {
  const PinTable table("xrp2", "");
  for (const PinUse& use : uses_of(board::xrp2::kWiring)) {
    const std::string header = table.header(use.pin);
    const std::string row = "| " + use.what + " | " + use.pin + ", " + (header.empty() ? use.meant : header) + " |";
    EXPECT_TRUE(document_has(row)) << row;
  }
}

// A wheel's pins are read at once (hal/mcu/rp2/encoder.hpp).
TEST(Rp2350Pins, EncodersHaveBothPinsInOneBank) {
  for (const board::Wiring& wiring : {board::pico2::kWiring, board::xrp2::kWiring}) {
    EXPECT_EQ(wiring.left.a.number / 32, wiring.left.b.number / 32);
    EXPECT_EQ(wiring.right.a.number / 32, wiring.right.b.number / 32);
  }
}

TEST(Rp2350Pins, FindsAPinOfAnotherSliceAndTheOtherBus) {
  board::Wiring wiring = board::xrp2::kWiring;
  wiring.left_motor.power = {20};
  wiring.i2c.data = {38};
  const Faults expected = {"bus data: GP38 is own sensor", "bus data: function 3 of GP38 is I2C1_SDA, not I2C0_SDA",
                           "left motor: GP20 is motor 3, not left motor"};
  EXPECT_EQ(faults_of("xrp2", wiring), expected);
}

}  // namespace
}  // namespace fencepost::test
