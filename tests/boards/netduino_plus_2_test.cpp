// The Netduino Plus 2's image in its emulator.
#include <gtest/gtest.h>

#include "tests/boards/counting.hpp"
#include "tests/boards/debugger.hpp"
#include "tests/boards/every_board.hpp"
#include "tests/boards/faults.hpp"
#include "tests/boards/netduino_plus_2.hpp"

namespace fencepost::test {
namespace {

// A frame of eight objects, all that it sets in motion. At 50 frames a second 336,000 cycles are a tenth of 168 MHz,
// that is 240,000 instructions at 1.4 cycles each. Most of it updates models and outlines of the objects whose turn it
// is. 600 frames are shown.
void count_eight_objects(PoseCorrected corrected) {
  const FullTable table{"netduino_plus_2",
                        with_floor({{"camera", "::Camera<fencepost::mcu::stm32f4::Uart>::receive("}}), eight_boxes(12),
                        8, 590};
  expect_full_table_as_committed(table, corrected, [](const auto& arguments) { return netduino_plus_2(arguments); });
}

EveryBoardFacts facts() {
  EveryBoardFacts facts;
  facts.board = [] { return netduino_plus_2(); };
  facts.name = "netduino_plus_2";
  facts.profile = "small";
  facts.reset = "unknown";
  facts.count = count_eight_objects;
  return facts;
}
INSTANTIATE_TEST_SUITE_P(NetduinoPlus2, EveryBoard, ::testing::Values(facts()), profile_of);

TEST(NetduinoPlus2, SurvivesAConsoleThatIsBlocked) { expect_survives_blocked_console(netduino_plus_2()); }
TEST(NetduinoPlus2, TellsOnceWhereTheLastRunDied) { expect_tells_of_a_fault(netduino_plus_2(), 0x08001235); }

}  // namespace
}  // namespace fencepost::test
