// The pins of boards with an RP2040 against what their makers say of them.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "hal/boards/pico/pins.hpp"
#include "hal/boards/xrp/pins.hpp"
#include "tests/hal/boards/pin_table.hpp"

namespace fencepost::test {
namespace {

namespace rp2040 = mcu::rp2040;

using Faults = std::vector<std::string>;

std::string name(rp2040::Pin pin) { return "GP" + std::to_string(pin.number); }

void add_line(std::vector<PinUse>& uses, const std::string& what, const rp2040::UartWiring& line) {
  const std::string of = line.base == rp2040::kUart0 ? "UART0" : "UART1";
  uses.push_back({what + " sends", name(line.transmit), of + "_TX", rp2040::kFunctionUart});
  uses.push_back({what + " receives", name(line.receive), of + "_RX", rp2040::kFunctionUart});
}

// What drives a motor of the robot's own is not on the header; another's is beside the board.
void add_motor(std::vector<PinUse>& uses, const std::string& side, const rp2040::MotorWiring& motor) {
  const std::string meant = motor.direction ? side + " motor" : "";
  const std::uint32_t n = motor.power.number;
  const std::string signal = "PWM" + std::to_string(n / 2 % 8) + (n % 2 == 0 ? "_A" : "_B");
  uses.push_back({side + " motor", name(motor.power), signal, rp2040::kFunctionPwm, meant});
  if (motor.direction) uses.push_back({side + " direction", name(*motor.direction), {}, 0, meant});
}

std::vector<PinUse> uses_of(const board::Wiring& wiring) {
  std::vector<PinUse> uses;
  if (wiring.console) add_line(uses, "console", *wiring.console);
  add_line(uses, "camera", wiring.camera);
  const std::string bus = wiring.i2c.base == rp2040::kI2c0 ? "I2C0" : "I2C1";
  uses.push_back({"bus data", name(wiring.i2c.data), bus + "_SDA", rp2040::kFunctionI2c});
  uses.push_back({"bus clock", name(wiring.i2c.clock), bus + "_SCL", rp2040::kFunctionI2c});
  uses.push_back({"left a", name(wiring.left.a)});
  uses.push_back({"left b", name(wiring.left.b)});
  uses.push_back({"right a", name(wiring.right.a)});
  uses.push_back({"right b", name(wiring.right.b)});
  if (wiring.light) uses.push_back({"light", name(*wiring.light), {}, 0, "led"});
  uses.push_back({"button", name(wiring.button), {}, 0, wiring.target == "xrp" ? "button" : ""});
  uses.push_back({"stop", name(wiring.stop)});
  add_motor(uses, "left", wiring.left_motor);
  add_motor(uses, "right", wiring.right_motor);
  return uses;
}

Faults faults_of(const std::string& table, const board::Wiring& wiring) {
  return PinTable(table, "rp2040_functions").faults(uses_of(wiring));
}

TEST(Rp2040Pins, PicoHasItsPinsRight) { EXPECT_EQ(faults_of("pico", board::pico::kWiring), Faults{}); }
TEST(Rp2040Pins, XrpHasItsPinsRight) { EXPECT_EQ(faults_of("xrp", board::xrp::kWiring), Faults{}); }

// What `status` says of them.
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
  wiring.right_motor.direction = rp2040::Pin{12};
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
