// The pins of each board against what its makers say of them.
#include "tests/hal/boards/pin_table.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "hal/boards/feather_f405/pins.hpp"
#include "hal/boards/microbit/pins.hpp"
#include "hal/boards/microbit_v2/pins.hpp"
#include "hal/boards/netduino_plus_2/pins.hpp"
#include "hal/boards/pyboard/pins.hpp"
#include "hal/mcu/stm32f4/i2c.hpp"
#include "hal/mcu/stm32f4/registers.hpp"

namespace fencepost::test {
namespace {

namespace stm32 = mcu::stm32f4;

using Faults = std::vector<std::string>;

std::string name(stm32::Pin pin) { return std::string("P") + pin.port + std::to_string(pin.number); }

std::string peripheral(std::uint32_t base) {
  const std::map<std::uint32_t, std::string> names = {
      {stm32::kUsart1, "USART1"}, {stm32::kUsart2, "USART2"}, {stm32::kUsart3, "USART3"}, {stm32::kUart4, "UART4"},
      {stm32::kUsart6, "USART6"}, {stm32::kTimer3, "TIM3"},   {stm32::kTimer4, "TIM4"},   {stm32::kTimer5, "TIM5"},
  };
  return names.at(base);
}

void add_line(std::vector<PinUse>& uses, const std::string& what, const stm32::UartWiring& line,
              const std::string& group = {}) {
  const std::string of = peripheral(line.part.base);
  uses.push_back({what + " sends", name(line.transmit), of + "_TX", line.part.function, {}, group});
  uses.push_back({what + " receives", name(line.receive), of + "_RX", line.part.function, {}, group});
}

void add_encoder(std::vector<PinUse>& uses, const std::string& what, const stm32::EncoderWiring& encoder) {
  const std::string of = peripheral(encoder.timer);
  uses.push_back({what + " a", name(encoder.a), of + "_CH1", stm32::kEncoderFunction, {}, "encoders"});
  uses.push_back({what + " b", name(encoder.b), of + "_CH2", stm32::kEncoderFunction, {}, "encoders"});
}

std::vector<PinUse> uses_of(const board::Wiring& wiring) {
  std::vector<PinUse> uses;
  add_line(uses, "console", wiring.console);
  add_line(uses, "camera", wiring.camera);
  add_line(uses, "base", wiring.base, "base");
  uses.push_back({"bus clock", name(wiring.i2c_clock), "I2C1_SCL", stm32::kI2cFunction});
  uses.push_back({"bus data", name(wiring.i2c_data), "I2C1_SDA", stm32::kI2cFunction});
  add_encoder(uses, "left", wiring.left);
  add_encoder(uses, "right", wiring.right);
  uses.push_back({"light", name(wiring.light), {}, 0, "led"});
  uses.push_back({"stop", name(wiring.stop)});
  if (wiring.power) uses.push_back({"power", name(*wiring.power), {}, 0, "header's power"});
  return uses;
}

Faults faults_of(const std::string& table, const board::Wiring& wiring) {
  return PinTable(table, "stm32f405_functions").faults(uses_of(wiring));
}

TEST(PinTable, NetduinoPlus2HasItsPinsRight) {
  EXPECT_EQ(faults_of("netduino_plus_2", board::netduino_plus_2::kWiring), Faults{});
}
TEST(PinTable, PyboardHasItsPinsRight) { EXPECT_EQ(faults_of("pyboard", board::pyboard::kWiring), Faults{}); }
TEST(PinTable, FeatherF405HasItsPinsRight) {
  EXPECT_EQ(faults_of("feather_f405", board::feather_f405::kWiring), Faults{});
}

// One map for the three boards, as it once was: a camera at USB power, a console at a battery.
board::Wiring one_for_all() {
  board::Wiring wiring = board::pyboard::kWiring;
  wiring.camera = {stm32::kUsart1Part, {'A', 9}, {'A', 10}};
  return wiring;
}
TEST(PinTable, FindsPinsThatAreUsbPower) {
  const Faults on_pyboard = {"camera sends: PA9 is USB VBUS", "camera sends: PA9 is not on the header",
                             "camera receives: PA10 is USB ID", "camera receives: PA10 is not on the header"};
  EXPECT_EQ(faults_of("pyboard", one_for_all()), on_pyboard);
  const Faults on_netduino = faults_of("netduino_plus_2", one_for_all());
  EXPECT_NE(std::find(on_netduino.begin(), on_netduino.end(), "camera receives: PA10 is led"), on_netduino.end());
  EXPECT_NE(std::find(on_netduino.begin(), on_netduino.end(), "base receives: PB11 is button"), on_netduino.end());
  const Faults on_feather = faults_of("feather_f405", one_for_all());
  EXPECT_NE(std::find(on_feather.begin(), on_feather.end(), "console sends: PA2 is not connected"), on_feather.end());
  EXPECT_NE(std::find(on_feather.begin(), on_feather.end(), "console receives: PA3 is battery"), on_feather.end());
}

TEST(PinTable, FindsAWrongFunctionAndAPinUsedTwice) {
  board::Wiring wiring = board::pyboard::kWiring;
  wiring.camera.part.function = 7;
  wiring.stop = wiring.i2c_data;
  const Faults expected = {"camera sends: function 7 of PC6 is nothing, not USART6_TX",
                           "camera receives: function 7 of PC7 is nothing, not USART6_RX",
                           "stop: PB9 is that of: bus data"};
  EXPECT_EQ(faults_of("pyboard", wiring), expected);
}

// `status` names them.
TEST(PinTable, TheBoardsNameTheirPinsRight) {
  const auto expect = [](const std::string& board, const board::Wiring& wiring) {
    const PinTable table(board, "");
    const auto of = [&](stm32::Pin pin) { return table.header(name(pin)); };
    EXPECT_EQ(wiring.names.line, of(wiring.camera.transmit) + " sends, " + of(wiring.camera.receive) + " receives");
    EXPECT_EQ(wiring.names.base, of(wiring.base.transmit) + " sends, " + of(wiring.base.receive) + " receives");
    EXPECT_EQ(wiring.names.two_wire, of(wiring.i2c_data) + " data, " + of(wiring.i2c_clock) + " clock");
  };
  expect("netduino_plus_2", board::netduino_plus_2::kWiring);
  expect("pyboard", board::pyboard::kWiring);
  expect("feather_f405", board::feather_f405::kWiring);
}

// "D3 PA2", or the part's name alone.
std::string cell(const PinTable& table, const std::string& pin) {
  const std::string header = table.header(pin);
  return header.empty() ? pin : header + " " + pin;
}
TEST(PinTable, TheDocumentHasThePins) {
  const PinTable netduino("netduino_plus_2", "");
  const PinTable pyboard("pyboard", "");
  const PinTable feather("feather_f405", "");
  const auto first = uses_of(board::netduino_plus_2::kWiring);
  const auto second = uses_of(board::pyboard::kWiring);
  const auto third = uses_of(board::feather_f405::kWiring);
  ASSERT_LE(second.size(), first.size());
  ASSERT_EQ(third.size(), second.size());
  for (std::size_t n = 0; n < second.size(); ++n) {
    const std::string row = "| " + first[n].what + " | " + cell(netduino, first[n].pin) + " | " +
                            cell(pyboard, second[n].pin) + " | " + cell(feather, third[n].pin) + " |";
    EXPECT_TRUE(document_has(row)) << row;
  }
}

template <std::uint32_t kPorts>
std::string name(mcu::nrf51::PinOf<kPorts> pin) {
  const std::uint32_t n = pin.number % 32;
  return "P" + std::to_string(pin.number / 32) + (n < 10 ? ".0" : ".") + std::to_string(n);
}

TEST(PinTable, MicrobitHasItsPinsRight) {
  namespace pins = board::microbit;
  std::vector<PinUse> uses = {{"console sends", name(pins::kConsoleSends), {}, 0, "USB serial line"},
                              {"console receives", name(pins::kConsoleReceives), {}, 0, "USB serial line"},
                              {"bus clock", name(pins::kBusClock)},
                              {"bus data", name(pins::kBusData)},
                              {"light's row", name(pins::kFirstRow), {}, 0, "light of the display"},
                              {"stop", name(pins::kStop)}};
  for (std::uint32_t n = 0; n < pins::kColumns; ++n) {
    const mcu::nrf51::Pin column{pins::kFirstColumn + n};
    uses.push_back({"light's column", name(column), {}, 0, "light of the display"});
  }
  EXPECT_EQ(PinTable("microbit", "").faults(uses), Faults{});
}

std::vector<PinUse> uses_of_microbit_v2() {
  namespace pins = board::microbit_v2;
  std::vector<PinUse> uses = {{"console sends", name(pins::kConsoleSends), {}, 0, "USB serial line"},
                              {"console receives", name(pins::kConsoleReceives), {}, 0, "USB serial line"},
                              {"bus clock", name(pins::kBusClock)},
                              {"bus data", name(pins::kBusData)},
                              {"heartbeat's row", name(pins::kHeartbeatRow), {}, 0, "light of the display"},
                              {"held's row", name(pins::kHeldRow), {}, 0, "light of the display"},
                              {"lit column", name(pins::kLitColumn), {}, 0, "light of the display"},
                              {"reset", name(pins::kReset), {}, 0, "reset button"},
                              {"camera sends", name(pins::kLineSends)},
                              {"camera receives", name(pins::kLineReceives)},
                              {"left a", name(pins::kLeftA)},
                              {"left b", name(pins::kLeftB)},
                              {"right a", name(pins::kRightA)},
                              {"right b", name(pins::kRightB)},
                              {"stop", name(pins::kStop)}};
  for (const mcu::nrf52::Pin column : pins::kDarkColumns) {
    uses.push_back({"dark column", name(column), {}, 0, "light of the display"});
  }
  return uses;
}

TEST(PinTable, MicrobitV2HasItsPinsRight) {
  EXPECT_EQ(PinTable("microbit_v2", "").faults(uses_of_microbit_v2()), Faults{});
}
TEST(PinTable, FindsAPinOfTheFirstMicrobitOnTheSecond) {
  const Faults expected = {"bus data: P0.30 is light of the display", "bus clock: P0.00 is speaker",
                           "bus clock: P0.00 is not on the header",
                           "console sends: P0.24 is light of the display, not USB serial line"};
  EXPECT_EQ(PinTable("microbit_v2", "")
                .faults({{"bus data", name(board::microbit::kBusData)},
                         {"bus clock", name(board::microbit::kBusClock)},
                         {"console sends", name(board::microbit::kConsoleSends), {}, 0, "USB serial line"}}),
            expected);
}
TEST(PinTable, TheDocumentHasThePinsOfTheMicrobits) {
  const auto row = [](const std::string& what, const PinTable& first, mcu::nrf51::Pin old, const PinTable& second,
                      mcu::nrf52::Pin pin) {
    return "| " + what + " | " + first.header(name(old)) + ", " + name(old) + " | " + second.header(name(pin)) + ", " +
           name(pin) + " |";
  };
  const PinTable first("microbit", "");
  const PinTable second("microbit_v2", "");
  namespace v1 = board::microbit;
  namespace v2 = board::microbit_v2;
  for (const std::string& line : {row("bus clock", first, v1::kBusClock, second, v2::kBusClock),
                                  row("bus data", first, v1::kBusData, second, v2::kBusData)}) {
    EXPECT_TRUE(document_has(line)) << line;
  }
  const auto second_alone = [&second](const std::string& what, const std::string& kind, mcu::nrf52::Pin pin) {
    return "| " + what + " | | " + kind + second.header(name(pin)) + ", " + name(pin) + " |";
  };
  for (const std::string& line : {second_alone("camera sends", "ring ", v2::kLineSends),
                                  second_alone("camera receives", "ring ", v2::kLineReceives),
                                  second_alone("left a", "", v2::kLeftA), second_alone("left b", "", v2::kLeftB),
                                  second_alone("right a", "", v2::kRightA), second_alone("right b", "", v2::kRightB)}) {
    EXPECT_TRUE(document_has(line)) << line;
  }
  const bus::PinNames& names = v2::kNames;
  EXPECT_EQ(names.line, "ring " + second.header(name(v2::kLineSends)) + " sends, ring " +
                            second.header(name(v2::kLineReceives)) + " receives");
  EXPECT_EQ(names.base, names.line);
  EXPECT_EQ(names.encoders, second.header(name(v2::kLeftA)) + " and " + second.header(name(v2::kLeftB)) + ", " +
                                second.header(name(v2::kRightA)) + " and " + second.header(name(v2::kRightB)));
  const std::string stop = "| stop | ring 1, " + name(v1::kStop) + " | ring 1, " + name(v2::kStop) + " |";
  EXPECT_TRUE(document_has(stop)) << stop;
}

}  // namespace
}  // namespace fencepost::test
