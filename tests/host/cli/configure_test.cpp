// `fencepost configure` as its users run it, on an image of a board that there is not.
#include <gtest/gtest.h>

#include <string>

#include "firmware/config/about_image.hpp"
#include "hal/mcu/about_board.hpp"
#include "tests/host/cli/run.hpp"

namespace fencepost::host::testing {
namespace {

template <class About>
std::string bytes_of(const About& about) {
  return {reinterpret_cast<const char*>(&about), sizeof about};
}

std::string image() {
  const config::DeviceLimits limits{
      0b110, 0b1, false, 0, false, config::Devices(config::CameraId::kPixy2, config::OdometryId::kConsole)};
  return "program" + bytes_of(mcu::about_board("testboard", 0x0800'0000, 0x0800'4000, 1024)) +
         bytes_of(config::about_image("0.1.0", 8, limits));
}

TEST(ConfigureCommand, WritesAFileThatSaysWhatWasTold) {
  spill("image.bin", image());
  const Outcome run = shell("fencepost configure image.bin --camera pixy2.1 --set alert.stop=0.3 -o mine.hex");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_TRUE(holds(run.err, "testboard, version 0.1.0: 2 lines in "));
  EXPECT_TRUE(holds(run.err, "  $FPCFG,camera,pixy2.1*"));
  EXPECT_TRUE(slurp("mine.hex").starts_with(":020000040800F2\r\n"));
  const Outcome again = shell("fencepost configure mine.hex -o mine.bin");
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(slurp("mine.bin").size(), 0x4000U + 2 * 1024);
}

struct Refused {
  const char* line;
  int exit_code;
  const char* says;
};
class ConfigureRefuses : public ::testing::TestWithParam<Refused> {};

TEST_P(ConfigureRefuses, AndWritesNothing) {
  spill("image.bin", image());
  spill("other.bin", "hello");
  spill("cut.hex", ":0300300002337A1E\n");
  const Outcome run = shell(std::string("fencepost configure ") + GetParam().line);
  EXPECT_EQ(run.exit_code, GetParam().exit_code) << run.err;
  EXPECT_TRUE(holds(run.err, GetParam().says));
  for (const char* name : {"mine.hex", "mine.uf2", "mine.sav", "mine.txt"})
    EXPECT_EQ(slurp(folder() / name), "") << name;
}
INSTANTIATE_TEST_SUITE_P(
    All, ConfigureRefuses,
    ::testing::Values(
        Refused{"image.bin --camera xbc -o mine.hex", 2, "image.bin: the image of testboard has no camera \"xbc\""},
        Refused{"image.bin --odometry encoders -o mine.hex", 2, "has no odometry \"encoders\"; it has console"},
        Refused{"image.bin --lens wide -o mine.hex", 2, "lens=wide is not possible; it takes 0 to 150 deg"},
        Refused{"image.bin --set alert.stop -o mine.hex", 2, "--set alert.stop is no KEY=VALUE"},
        Refused{"image.bin -o mine.uf2", 2, "mine.uf2: testboard takes no UF2 files; write .hex or .bin"},
        Refused{"image.bin -o mine.sav", 2, "only a cartridge has a .sav"},
        Refused{"image.bin -o mine.txt", 2, "mine.txt: its name has to end with .uf2, .hex, .bin, .dfu or .sav"},
        Refused{"image.bin", 2, "--output is required"},
        Refused{"other.bin -o mine.hex", 3, "other.bin: this is no image of Fencepost"},
        Refused{"other.bin -o mine.hex", 3, "share/doc/boards.md tells which to take"},
        Refused{"cut.hex -o mine.hex", 3,
                "cut.hex: the file is cut off: its last line is missing; share/doc/boards.md"},
        Refused{"missing.uf2 -o mine.uf2", 3, "missing.uf2"},
        Refused{"image.bin --robot missing.json -o mine.hex", 3, "missing.json"}));

}  // namespace
}  // namespace fencepost::host::testing
