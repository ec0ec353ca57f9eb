#include "host/emulate/scene/device_kind.hpp"

#include <gtest/gtest.h>

#include "host/emulate/transport/words.hpp"
#include "tests/drivers/hex.hpp"

namespace fencepost::emulate {
namespace {

using Place = DeviceSpec::Place;

DeviceSpec spec(const std::string& text) {
  const ParsedDevice parsed = parse_device(text);
  EXPECT_EQ(parsed.problem, "") << text;
  return parsed.spec;
}

TEST(DeviceSpec, NamesAKindAndAPlace) {
  EXPECT_EQ(spec("pixy2").place, Place::kPty);
  EXPECT_EQ(spec("pixy2").where, "");
  EXPECT_EQ(spec("pixy2:pty").where, "");
  EXPECT_EQ(spec("pixy2:/tmp/cam").where, "/tmp/cam");
  EXPECT_EQ(spec("cmucam4:tcp:7000").place, Place::kTcp);
  EXPECT_EQ(spec("cmucam4:tcp:7000").where, "7000");
  EXPECT_EQ(spec("cmucam4:tcp:0.0.0.0:7000").where, "0.0.0.0:7000");
  EXPECT_EQ(spec("can:vcan0").place, Place::kCan);
  EXPECT_EQ(spec("can:vcan0,layout=talon,tick=0.001").where, "vcan0");
  EXPECT_TRUE(spec("can:vcan0,layout=talon").talon);
}

TEST(DeviceSpec, HasTheDevicesOwnNumbersUnlessTold) {
  EXPECT_EQ(spec("pixy2").baud, 19'200U);
  EXPECT_EQ(spec("create1").baud, 57'600U);
  EXPECT_EQ(spec("create2:/tmp/c,baud=19200,track=0.3").baud, 19'200U);
  EXPECT_DOUBLE_EQ(spec("create2,track=0.3").wheels.track, 0.3);
  EXPECT_NEAR(spec("create2").wheels.tick, 0.00044456, 1e-7);
  EXPECT_NEAR(spec("nxt").wheels.tick, 0.00048869, 1e-8);  // pi * 56 mm / 360
}

TEST(DeviceSpec, PutsAnNxtCamOnTheBrick) {
  EXPECT_FALSE(spec("nxt").camera_port);
  EXPECT_EQ(spec("nxtcam:nxt").kind->name, "nxt");
  EXPECT_EQ(spec("nxtcam:nxt").camera_port, 1);
  EXPECT_EQ(spec("nxtcam@nxt,port=4").camera_port, 4);
  EXPECT_EQ(spec("nxtcam:nxt:/tmp/brick,port=2").where, "/tmp/brick");
  EXPECT_EQ(spec("nxtcam@nxt:/tmp/brick").where, "/tmp/brick");
  EXPECT_EQ(spec("nxtcam").kind->name, "nxtcam");
}

TEST(DeviceSpec, SaysWhatIsWrong) {
  for (const char* text : {"", "pixy3", "pixy2:tcp:", "can", "can:", "pixy2:usb", "nxtcam:/dev/i2c-1", "pixy2,tick=1",
                           "pixy2,baud=fast", "pixy2,baud=7", "create2,track=0", "nxt,port=1", "nxtcam:nxt,port=5",
                           "can:vcan0,layout=odd", "pixy2,,", "pixy2,baud=9600,baud=9600", "pixy2,baud=9600.5"}) {
    EXPECT_NE(parse_device(text).problem, "") << text;
  }
}

TEST(Words, SayWhatTheBytesMean) {
  using test::hex;
  EXPECT_EQ(hex_of(hex("AE C1 0E 00")), "AE C1 0E 00");
  EXPECT_EQ(hex_of(hex("AE C1 0E 00"), 2), "AE C1 ...");
  EXPECT_EQ(words_of(Speech::kPixy2, true, hex("AE C1 20 02 FF FF")), "getBlocks");
  EXPECT_EQ(words_of(Speech::kPixy2, false, hex("AF C1 03 01 FE 00 FE")), "error busy: no new frame");
  EXPECT_EQ(words_of(Speech::kPixy2, false, hex("AF C1 21 00 00 00")), "0 blocks");
  EXPECT_EQ(words_of(Speech::kText, true, hex("47 56 0D")), "\"GV\\r\"");
  EXPECT_EQ(words_of(Speech::kCreate, true, hex("80 94 02 2B 2C")), "start, stream");
  EXPECT_EQ(words_of(Speech::kNxt, true, hex("03 00 00 06 01")), "get output state");
  EXPECT_EQ(words_of(Speech::kNxt, false, hex("03 00 02 05 C0")), "set input mode: out of range");
  EXPECT_EQ(words_of(Speech::kNxtCam5, true, hex("55 AA 01 03 45 48")), "command 'E'");
  EXPECT_EQ(words_of(Speech::kNxtCam5, false, hex("55 AA 07 04 02 00 02 3C 28 52 47 0B")), "1 blobs");
  EXPECT_EQ(words_of(Speech::kAvrcam, false, hex("0A 02 02 3C 28 50 46")), "2 objects");
}

}  // namespace
}  // namespace fencepost::emulate
