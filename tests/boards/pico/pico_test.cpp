// The Raspberry Pi Pico's image in its emulator.
#include <gtest/gtest.h>

#include "tests/boards/bench.hpp"
#include "tests/boards/counting.hpp"
#include "tests/boards/every_board.hpp"
#include "tests/boards/pico/pico.hpp"
#include "tests/firmware/loop/desk.hpp"

namespace fencepost::test {
namespace {

// A frame of eight objects, all that it sets in motion.
void count_eight_objects(PoseCorrected corrected) {
  const FullTable table{"pico", with_floor({{"camera", "::Camera<fencepost::mcu::rp2::Uart>::receive("}}),
                        eight_boxes(4), 8, 100};
  expect_full_table_as_committed(table, corrected,
                                 [](const auto& arguments) { return pico(nullptr, "fencepost", arguments.back()); });
}

EveryBoardFacts facts() {
  EveryBoardFacts facts;
  facts.board = [] { return pico(); };
  facts.name = "pico";
  facts.profile = "small";
  facts.reset = "power on";
  facts.corrected_seconds = 10;
  facts.count = count_eight_objects;
  return facts;
}
INSTANTIATE_TEST_SUITE_P(Pico, EveryBoard, ::testing::Values(facts()), profile_of);

// host/share/doc/FIRST_ALERT.md, steps 6 and 7: pushed by hand towards a red post, at 0.1 m/s.
TEST(Pico, SaysTheFirstAlertAsItsGuideDoes) {
  Bench bench(pico());
  ASSERT_TRUE(bench.await("odometry is silent: no $FPODO records come over the console; send them\r\n"))
      << bench.said();
  EXPECT_TRUE(bench.obey("selftest", "selftest pass")) << bench.said();
  bench.clear();
  bench.console().send(line_of(level_pixy2()));
  bench.console().send(line_of(record::Signature{1, {0xd0, 0x20, 0x20}, "red"}));
  for (std::uint32_t i = 0; i < 160; ++i) {
    const double x = 0.005 * i;
    bench.give(desk_odometry(0.05 * i, x));
    bench.give(desk_frame(0.05 * i, i, x));
    bench.run(0.05);
  }
  std::size_t at = 0;
  for (const std::string_view sentence :
       {"odometry works\r\n", "NOTICE  red  0.", "WARN    red  0.4", "STOP    red  0.2"}) {
    at = bench.said().find(sentence, at);
    ASSERT_NE(at, std::string::npos) << sentence << " is not in\n" << bench.said();
  }
  EXPECT_TRUE(bench.obey("status", "camera link ok, pixy2 316x208; odometry link ok")) << bench.said();
}

}  // namespace
}  // namespace fencepost::test
