// The Pico 2's program on a machine with the same core: bits and instructions. No emulator has the part; that its
// images start there, and what they do to it, is starts_test.py.
#include <gtest/gtest.h>

#include "tests/boards/counting.hpp"
#include "tests/boards/every_board.hpp"
#include "tests/boards/pico2/pico2.hpp"

namespace fencepost::test {
namespace {

// A frame of eight objects, all that it sets in motion. At 50 frames a second 300,000 cycles are a tenth of 150 MHz.
// 600 frames are shown.
void count_eight_objects(PoseCorrected corrected) {
  const FullTable table{
      "pico2",     with_floor({{"camera", "::Camera<fencepost::mcu::rp2::Uart>::receive("}}), eight_boxes(12), 8, 590,
      kPico2OnMps2};
  expect_full_table_as_committed(table, corrected, [](const auto& arguments) { return pico2(arguments); });
}

EveryBoardFacts facts() {
  EveryBoardFacts facts;
  facts.board = [] { return pico2(); };
  facts.name = "pico2";
  facts.profile = "small";
  facts.reset = "power on";
  facts.count = count_eight_objects;
  return facts;
}
INSTANTIATE_TEST_SUITE_P(Pico2, EveryBoard, ::testing::Values(facts()), profile_of);

}  // namespace
}  // namespace fencepost::test
