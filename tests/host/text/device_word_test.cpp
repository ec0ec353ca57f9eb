#include "host/text/device_word.hpp"

#include <gtest/gtest.h>

namespace fencepost::host {
namespace {

TEST(DeviceWord, HasAKindAPlaceAndOptions) {
  const DeviceWord word = split_device("cmucam2:tcp:robot:4001,baud=9600,imager=ov7620");
  EXPECT_EQ(word.kind, "cmucam2");
  EXPECT_EQ(word.place, "tcp:robot:4001");
  ASSERT_EQ(word.options.size(), 2U);
  EXPECT_EQ(word.options[0].name, "baud");
  EXPECT_EQ(word.options[0].value, "9600");
  EXPECT_EQ(word.options[1].name, "imager");
  EXPECT_EQ(word.options[1].value, "ov7620");
  EXPECT_EQ(word.problem, "");
}

TEST(DeviceWord, MayBeAKindAlone) {
  EXPECT_EQ(split_device("console").kind, "console");
  EXPECT_FALSE(split_device("console").place);
  EXPECT_EQ(split_device("console:").place, "");
  EXPECT_EQ(split_device("").kind, "");
  EXPECT_EQ(split_device("nxt,left=A").kind, "nxt");
  EXPECT_FALSE(split_device("nxt,left=A:B").place) << "a colon of an option is none of a place";
  EXPECT_EQ(split_device("x,a=b=c").options[0].value, "b=c");
}

TEST(DeviceWord, TellsOptionsThatAreNone) {
  EXPECT_EQ(split_device("x,").problem, "\"\" is no option; write NAME=VALUE");
  EXPECT_EQ(split_device("x,fast").problem, "\"fast\" is no option; write NAME=VALUE");
  EXPECT_EQ(split_device("x,a=1,b=2,a=3").problem, "a is given twice; remove one");
  EXPECT_EQ(split_device("x,fast,a=1,a=1").problem, "\"fast\" is no option; write NAME=VALUE") << "the first one";
}

TEST(DeviceWord, WholeNumbersAreDecimalOrHexadecimal) {
  EXPECT_EQ(whole_number("19200"), 19'200U);
  EXPECT_EQ(whole_number("0x54"), 0x54U);
  EXPECT_EQ(whole_number("4294967295"), 4'294'967'295U);
  for (const char* text : {"", "0x", "-1", "+1", " 1", "1 ", "1.0", "4294967296", "fast"}) {
    EXPECT_FALSE(whole_number(text)) << text;
  }
}

TEST(DeviceWord, SaysWhatThereIsInstead) {
  EXPECT_EQ(no_such("camera", "pixi2", {"pixy2", "xbc"}),
            "there is no camera \"pixi2\"; did you mean pixy2? allowed: pixy2, xbc");
  EXPECT_EQ(no_such("camera", "lidar360", {"pixy2", "xbc"}), "there is no camera \"lidar360\"; allowed: pixy2, xbc");
}

}  // namespace
}  // namespace fencepost::host
