// The grammar of `fencepost emulate`, and what comes of it.
#include "host/devices/emulated.hpp"

#include <gtest/gtest.h>

namespace fencepost::devices {
namespace {

DeviceSpec spec(const std::string& text) {
  const auto parsed = parse_device(text, Use::kEmulated);
  EXPECT_TRUE(parsed.ok()) << parsed.error();
  return *parsed;
}

TEST(EmulatedSpec, NamesAKindAndAPlace) {
  EXPECT_EQ(spec("pixy2").place.kind, PlaceKind::kTty);
  EXPECT_EQ(spec("pixy2").place.name, "");
  EXPECT_EQ(spec("pixy2:pty").place.name, "");
  EXPECT_EQ(spec("pixy2:/tmp/cam").place.name, "/tmp/cam");
  EXPECT_EQ(spec("cmucam4:tcp:7000").place.kind, PlaceKind::kTcp);
  EXPECT_EQ(spec("cmucam4:tcp:7000").place.name, "7000");
  EXPECT_EQ(spec("cmucam4:tcp:0.0.0.0:7000").place.name, "0.0.0.0:7000");
  EXPECT_EQ(spec("can:vcan0").place.kind, PlaceKind::kCan);
  EXPECT_EQ(spec("can:vcan0,layout=talon,tick=0.001").place.name, "vcan0");
  EXPECT_EQ(spec("can:vcan0,layout=talon").option("layout"), "talon");
}

TEST(EmulatedSpec, HasTheDevicesOwnNumbersUnlessTold) {
  EXPECT_EQ(spec("pixy2").number("baud"), 19'200U);
  EXPECT_EQ(spec("create1").number("baud"), 57'600U);
  EXPECT_EQ(spec("create2:/tmp/c,baud=19200,track=0.3").number("baud"), 19'200U);
  EXPECT_DOUBLE_EQ(wheels_of(spec("create2,track=0.3")).track, 0.3);
  EXPECT_NEAR(wheels_of(spec("create2")).tick, 0.00044456, 1e-7);
  EXPECT_NEAR(wheels_of(spec("nxt")).tick, 0.00048869, 1e-8);  // pi * 56 mm / 360
}

TEST(EmulatedSpec, PutsAnNxtCamOnTheBrick) {
  EXPECT_FALSE(emulated(spec("nxt")).image) << "a brick alone sees nothing";
  EXPECT_TRUE(emulated(spec("nxtcam:nxt")).image);
  EXPECT_EQ(label_of_emulated(spec("nxtcam:nxt")), "nxt");
  EXPECT_EQ(spec("nxtcam:nxt").number("port"), 1U);
  EXPECT_EQ(spec("nxtcam@nxt,port=4").number("port"), 4U);
  EXPECT_EQ(spec("nxtcam:nxt:/tmp/brick,port=2").place.name, "/tmp/brick");
  EXPECT_EQ(spec("nxtcam@nxt:/tmp/brick").place.name, "/tmp/brick");
  EXPECT_EQ(label_of_emulated(spec("nxtcam")), "nxtcam");
}

TEST(EmulatedSpec, SaysWhatIsWrong) {
  for (const char* text : {"", "pixy3", "pixy2:tcp:", "can", "can:", "pixy2:usb", "nxtcam:/dev/i2c-1", "pixy2,tick=1",
                           "pixy2,baud=fast", "pixy2,baud=7", "create2,track=0", "nxt,port=1", "nxtcam:nxt,port=5",
                           "can:vcan0,layout=odd", "pixy2,,", "pixy2,baud=9600,baud=9600", "pixy2,baud=9600.5"}) {
    EXPECT_FALSE(parse_device(text, Use::kEmulated).ok()) << text;
  }
}

}  // namespace
}  // namespace fencepost::devices
