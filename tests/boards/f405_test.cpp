// The STM32F405 image in its emulator.
#include <gtest/gtest.h>

#include "tests/boards/counting.hpp"
#include "tests/boards/debugger.hpp"
#include "tests/boards/every_board.hpp"
#include "tests/boards/f405.hpp"
#include "tests/boards/faults.hpp"

namespace fencepost::test {
namespace {

// A frame of eight objects, all that it sets in motion. At 50 frames a second 336,000 cycles are a tenth of 168 MHz,
// that is 240,000 instructions at 1.4 cycles each. Most of it updates models and outlines of the objects whose turn it
// is. 600 frames are shown.
void count_eight_objects(PoseCorrected corrected) {
  const FullTable table{
      "f405", {{"camera", "::Camera<fencepost::mcu::stm32f4::Uart>::receive("}}, eight_boxes(12), 8, 590};
  expect_full_table_as_committed(table, corrected, [](const auto& arguments) { return f405(arguments); });
}

EveryBoardFacts facts() {
  EveryBoardFacts facts;
  facts.board = [] { return f405(); };
  facts.name = "f405";
  facts.profile = "small";
  facts.reset = "unknown";
  facts.count = count_eight_objects;
  return facts;
}
INSTANTIATE_TEST_SUITE_P(F405, EveryBoard, ::testing::Values(facts()), profile_of);

TEST(F405, SurvivesAConsoleThatIsBlocked) { expect_survives_blocked_console(f405()); }
TEST(F405, TellsOnceWhereTheLastRunDied) { expect_tells_of_a_fault(f405(), 0x08001235); }

}  // namespace
}  // namespace fencepost::test
