// `fencepost emulate` as its users run it: what it prints, how it ends, and what it says when it cannot.
#include <gtest/gtest.h>

#include <regex>

#include "tests/host/cli/run.hpp"

namespace fencepost::host {
namespace {

using namespace testing;

const std::string kScene = recording("approach_stop.json");

TEST(Emulate, PrintsWhereTheDevicesAreAndEndsByItself) {
  const Outcome run = shell("fencepost emulate pixy2 create2:tcp:0 " + kScene +
                            " --link cam --delay 0 --seconds 0.3; echo $? >code; test -e cam; echo $? >link");
  EXPECT_TRUE(std::regex_match(run.out, std::regex("pixy2 on cam\ncreate2 on 127\\.0\\.0\\.1:[1-9][0-9]*\n")))
      << run.out;
  EXPECT_EQ(testing::slurp("code"), "0\n");
  EXPECT_EQ(testing::slurp("link"), "1\n") << "the link is removed";
  EXPECT_TRUE(holds(run.err, "time begins"));
  EXPECT_TRUE(holds(run.err, "pixy2: 0 bytes heard"));
}

TEST(Emulate, PlaysALogAndStandardInput) {
  const Outcome run =
      shell("cat " + recording("approach_stop.log") + " | fencepost emulate cmucam4 - --delay 0 --seconds 0.2");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.out.rfind("cmucam4 on /dev/pts/", 0), 0U) << run.out;
  EXPECT_TRUE(holds(run.err, "boxes of 316 x 208 pixels are scaled to its 160 x 120"));
  EXPECT_TRUE(holds(run.err, "$FPCAM,cmucam4,160,120,"));
}

// The scene lasts longer than the test has patience: only the signal ends it.
TEST(Emulate, InterruptedCleansUpAndTells) {
  const Outcome run = shell("'" FENCEPOST_EXE "' emulate pixy2 " + kScene +
                            " --link cam & "
                            "for i in $(seq 500); do test -L cam && break; sleep 0.02; done; "
                            "test -L cam || echo missing; "
                            "kill -TERM $!; wait $!; echo $?; test -e cam; echo $?");
  EXPECT_EQ(run.out, "pixy2 on cam\n0\n1\n") << run.err;
  EXPECT_TRUE(holds(run.err, "pixy2: 0 bytes heard"));
}

// Start, two opcodes that a Create 2 does not have, a packet that it does not have.
TEST(Emulate, SaysWhatWasAskedForInVain) {
  const Outcome run = shell("fencepost emulate create2 " + kScene +
                            " --link base --seconds 1.5 & "
                            "for i in $(seq 500); do test -L base && break; sleep 0.02; done; "
                            "(sleep 0.1; printf '\\200\\310\\311\\310\\216\\077\\216\\043'; sleep 0.5) >base; wait");
  EXPECT_TRUE(holds(run.err, "  3 not emulated: opcode 200, opcode 201, packet 63\n"));
}

TEST(Emulate, CountsFaultsAtTheEnd) {
  const Outcome run = shell("fencepost emulate records:tcp:0 pixy2 " + kScene +
                            " --delay 0 --seconds 1 --fault reboot=0.3 --fault pixy2:unplug=0.2:0.1 --verbose");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(holds(run.err, "records: switched off and on"));
  EXPECT_TRUE(holds(run.err, "pixy2: unplugged"));
  EXPECT_TRUE(holds(run.err, "3 reboots, 3 unplugs"));
  EXPECT_TRUE(holds(run.err, "3 reboots, 0 unplugs"));
}

TEST(Emulate, TellsWhatTheSceneCannotGive) {
  const std::string rest = " --delay 0 --seconds 0.1";
  EXPECT_NE(shell("fencepost emulate create2 " + recording("blocks_arc.json") + rest).err.find("sideways"),
            std::string::npos);
  EXPECT_EQ(shell("fencepost emulate create2 " + kScene + rest).err.find("sideways"), std::string::npos);
  EXPECT_NE(shell("fencepost emulate pixy2.1 " + kScene + rest).err.find("focal length 273.6"), std::string::npos);
}

struct Wrong {
  const char* words;
  int code;
  const char* says;
};

class EmulateError : public ::testing::TestWithParam<Wrong> {};

TEST_P(EmulateError, EndsWithItsCodeAndSaysWhy) {
  spill("bad.json", "{\"format\": 1, \"camera\": 7}");
  spill("empty.log", "");
  spill("taken", "mine");
  const Outcome scene = shell("cp " + kScene + " scene.json");
  ASSERT_EQ(scene.exit_code, 0);
  const Outcome run = shell("fencepost emulate " + std::string(GetParam().words) + " --delay 0 --seconds 0.1");
  EXPECT_EQ(run.exit_code, GetParam().code) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_TRUE(holds(run.err, GetParam().says));
}

INSTANTIATE_TEST_SUITE_P(
    All, EmulateError,
    ::testing::Values(Wrong{"pixi2 scene.json", 2, "did you mean pixy2?"},
                      Wrong{"lidar360 scene.json", 2, "allowed: cmucam1, cmucam2, cmucam3"},
                      Wrong{"scene.json", 2, "a device and a scene or log are needed"},
                      Wrong{"pixy2,baud=x scene.json", 2, "baud=x is not possible"},
                      Wrong{"pixy2:usb scene.json", 2, "only on a pty"},
                      Wrong{"pixy2 scene.json --fault sneeze=1", 2, "no fault \"sneeze\""},
                      Wrong{"pixy2 scene.json --fault drop=2", 2, "drop=0.01"},
                      Wrong{"pixy2 scene.json --fault xbc:drop=0.1", 2, "no device xbc here"},
                      Wrong{"pixy2 scene.json --link a --link b", 2, "more links than devices"},
                      Wrong{"pixy2 scene.json --speed 0", 2, "0 is not a number above 0"},
                      Wrong{"pixy2 missing.json", 3, "missing.json"}, Wrong{"pixy2 bad.json", 3, "bad.json: /camera"},
                      Wrong{"pixy2 empty.log", 3, "no frame"},
                      Wrong{"pixy2 scene.json --link taken", 4, "remove it, or choose another path"},
                      Wrong{"pixy2 scene.json --link no/folder/cam", 4, "no/folder/cam"},
                      Wrong{"pixy2 scene.json --listen 192.0.2.1:7000", 4, "no address of this machine"},
                      Wrong{"pixy2 scene.json --listen 99999", 4, "that is no port"},
                      Wrong{"can:nosuch0 scene.json", 4, "nosuch0"}));

}  // namespace
}  // namespace fencepost::host
