#include "host/devices/device_spec.hpp"

#include <gtest/gtest.h>

namespace fencepost::devices {
namespace {

constexpr Use kCamera = Use::kCamera;
constexpr Use kOdometry = Use::kOdometry;

struct Good {
  std::string text;
  Use use;
  PlaceKind place;
  const char* name;
  const char* where;
};

TEST(DeviceSpec, ReadsEveryKindAtItsPlaces) {
  const Good kGood[] = {
      {"pixy2:/dev/ttyUSB0", kCamera, PlaceKind::kTty, "/dev/ttyUSB0", "pixy2 at /dev/ttyUSB0"},
      {"pixy2.1:/dev/serial/by-id/usb-1", kCamera, PlaceKind::kTty, "/dev/serial/by-id/usb-1",
       "pixy2.1 at /dev/serial/by-id/usb-1"},
      {"pixy2:/dev/i2c-1", kCamera, PlaceKind::kI2c, "/dev/i2c-1", "pixy2 at /dev/i2c-1"},
      {"pixy2:/dev/spidev0.0", kCamera, PlaceKind::kSpi, "/dev/spidev0.0", "pixy2 at /dev/spidev0.0"},
      {"pixy2:usb", kCamera, PlaceKind::kUsb, "usb", "pixy2 on USB"},
      {"cmucam1:./pty", kCamera, PlaceKind::kTty, "./pty", "cmucam1 at ./pty"},
      {"cmucam2:tcp:robot:4001", kCamera, PlaceKind::kTcp, "robot", "cmucam2 at robot:4001"},
      {"cmucam3:tcp:[::1]:65535", kCamera, PlaceKind::kTcp, "::1", "cmucam3 at ::1:65535"},
      {"cmucam4:/dev/ttyS0", kCamera, PlaceKind::kTty, "/dev/ttyS0", "cmucam4 at /dev/ttyS0"},
      {"nxtcam:nxt", kCamera, PlaceKind::kNxt, "nxt", "nxtcam behind the NXT brick"},
      {"nxtcam:/dev/i2c-7", kCamera, PlaceKind::kI2c, "/dev/i2c-7", "nxtcam at /dev/i2c-7"},
      {"nxtcam5:/dev/ttyS1", kCamera, PlaceKind::kTty, "/dev/ttyS1", "nxtcam5 at /dev/ttyS1"},
      {"avrcam:/dev/ttyS1", kCamera, PlaceKind::kTty, "/dev/ttyS1", "avrcam at /dev/ttyS1"},
      {"v4l2:/dev/video0", kCamera, PlaceKind::kVideo, "/dev/video0", "v4l2 at /dev/video0"},
      {"video:run.y4m", kCamera, PlaceKind::kFilm, "run.y4m", "video at run.y4m"},
      {"video:./run.mjpeg", kCamera, PlaceKind::kFilm, "./run.mjpeg", "video at ./run.mjpeg"},
      {"xbc:/dev/ttyS1", kCamera, PlaceKind::kTty, "/dev/ttyS1", "xbc at /dev/ttyS1"},
      {"console", kCamera, PlaceKind::kNone, "", "console"},
      {"create1:/dev/ttyS0", kOdometry, PlaceKind::kTty, "/dev/ttyS0", "create1 at /dev/ttyS0"},
      {"create2:/dev/ttyS0", kOdometry, PlaceKind::kTty, "/dev/ttyS0", "create2 at /dev/ttyS0"},
      {"nxt:usb", kOdometry, PlaceKind::kUsb, "usb", "nxt on USB"},
      {"nxt:/dev/rfcomm0", kOdometry, PlaceKind::kTty, "/dev/rfcomm0", "nxt at /dev/rfcomm0"},
      {"can:can0", kOdometry, PlaceKind::kCan, "can0", "can at can0"},
      {"records:/dev/ttyACM0", kOdometry, PlaceKind::kTty, "/dev/ttyACM0", "records at /dev/ttyACM0"},
      {"console", kOdometry, PlaceKind::kNone, "", "console"},
  };
  for (const Good& good : kGood) {
    const auto spec = parse_device(good.text, good.use);
    ASSERT_TRUE(spec.ok()) << spec.error();
    EXPECT_EQ(good.text.substr(0, good.text.find(':')), spec->kind_name());
    EXPECT_EQ(spec->place.kind, good.place) << good.text;
    EXPECT_EQ(spec->place.name, good.name) << good.text;
    EXPECT_EQ(spec->where(), good.where);
    EXPECT_EQ(spec->text, good.text);
  }
}

TEST(DeviceSpec, ReadsOptions) {
  const auto spec = parse_device("pixy2:/dev/i2c-1,address=0x55", kCamera);
  ASSERT_TRUE(spec.ok()) << spec.error();
  EXPECT_EQ(spec->number("address"), 0x55U);
  EXPECT_EQ(spec->number("hertz"), 2'000'000U) << "as the catalogue has it";
  const auto cmucam = parse_device("cmucam2:/dev/ttyS0,baud=38400,imager=ov7620", kCamera);
  ASSERT_TRUE(cmucam.ok()) << cmucam.error();
  EXPECT_EQ(cmucam->number("baud"), 38'400U);
  EXPECT_EQ(cmucam->option("imager"), "ov7620");
  EXPECT_EQ(cmucam->option("resolution"), "low");
  EXPECT_EQ(parse_device("nxtcam:nxt,port=4", kCamera)->number("port"), 4U);
  EXPECT_EQ(parse_device("nxt:usb,serial=0016530abc", kOdometry)->option("serial"), "0016530abc");
  EXPECT_EQ(parse_device("cmucam1:tcp:10.0.0.2:4001", kCamera)->place.port, 4001);
}

struct Bad {
  const char* text;
  Use use;
  const char* message;
};

TEST(DeviceSpec, SaysWhatIsWrongAndWhatIsAllowed) {
  const Bad kBad[] = {
      {"", kCamera, "there is no camera \"\"; allowed: cmucam1, cmucam2, cmucam3"},
      {"pixi2:usb", kCamera, "did you mean pixy2?"},
      {"craete2:/dev/x", kOdometry, "did you mean create2?"},
      {"webcam:/dev/video0", kCamera, "there is no camera \"webcam\"; allowed: cmucam1"},
      {"create2:/dev/x", kCamera, "create2 is for --odometry"},
      {"pixy2", kCamera, "where is it? Write pixy2:PLACE, a place being /dev/tty..., tcp:HOST:PORT"},
      {"pixy2:", kCamera, "where is it?"},
      {"pixy2:ttyUSB0", kCamera, "\"ttyUSB0\" is no place for it; allowed: /dev/tty..."},
      {"pixy2:nxt", kCamera, "\"nxt\" is no place for it"},
      {"create1:usb", kOdometry, "\"usb\" is no place for it; allowed: /dev/tty..., tcp:HOST:PORT"},
      {"create1:/dev/i2c-1", kOdometry, "\"/dev/i2c-1\" is no place for it"},
      {"can:/dev/ttyS0", kOdometry, "is no place for it; allowed: a CAN interface"},
      {"can:tcp:x", kOdometry, "is no tcp:HOST:PORT; ports are 1 to 65535"},
      {"cmucam1:tcp:robot", kCamera, "\"tcp:robot\" is no tcp:HOST:PORT"},
      {"cmucam1:tcp:robot:0", kCamera, "is no tcp:HOST:PORT"},
      {"cmucam1:tcp:robot:65536", kCamera, "is no tcp:HOST:PORT"},
      {"cmucam1:tcp::80", kCamera, "is no tcp:HOST:PORT"},
      {"v4l2:/dev/ttyS0", kCamera, "\"/dev/ttyS0\" is no place for it; allowed: /dev/videoN"},
      {"v4l2:run.y4m", kCamera, "\"run.y4m\" is no place for it; allowed: /dev/videoN"},
      {"video:/dev/video0", kCamera, "\"/dev/video0\" is no place for it; allowed: FILM.y4m"},
      {"v4l2:/dev/video0,size=1x1", kCamera, "size=1x1 is not possible; allowed: 320x240, 160x120, 640x480"},
      {"console:/dev/ttyS0", kCamera, "the console has no place"},
      {"pixy2:/dev/ttyS0,baud", kCamera, "\"baud\" is no option; write NAME=VALUE"},
      {"pixy2:/dev/ttyS0,buad=9600", kCamera, "no option \"buad\" of pixy2 at /dev/tty...; did you mean baud?"},
      {"pixy2:/dev/ttyS0,address=1", kCamera, "no option \"address\" of pixy2 at /dev/tty...; allowed: baud"},
      {"pixy2:/dev/ttyS0,baud=fast", kCamera, "baud=fast is not possible; allowed: whole numbers from 50 to 4000000"},
      {"pixy2:/dev/ttyS0,baud=9600,baud=9600", kCamera, "baud is given twice"},
      {"pixy2:/dev/i2c-1,address=128", kCamera, "address=128 is not possible; allowed: whole numbers from 1 to 127"},
      {"nxtcam:nxt,port=5", kCamera, "port=5 is not possible; allowed: whole numbers from 1 to 4"},
      {"cmucam2:/dev/ttyS0,imager=ov", kCamera, "imager=ov is not possible; allowed: ov6620, ov7620"},
      {"cmucam1:/dev/ttyS0,imager=ov7620", kCamera, "no option \"imager\" of cmucam1"},
      {"can:can0,baud=1", kOdometry, "no options are known of can"},
      {"nxt:usb,serial=", kOdometry, "serial is empty"},
  };
  for (const Bad& bad : kBad) {
    const auto spec = parse_device(bad.text, bad.use);
    ASSERT_FALSE(spec.ok()) << bad.text;
    EXPECT_NE(spec.error().find(bad.message), std::string::npos) << spec.error();
    EXPECT_NE(spec.error().find(std::string("\"") + bad.text + "\""), std::string::npos) << spec.error();
  }
}

}  // namespace
}  // namespace fencepost::devices
