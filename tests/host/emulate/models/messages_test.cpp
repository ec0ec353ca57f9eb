#include "host/emulate/models/messages.hpp"

#include <gtest/gtest.h>

#include "tests/drivers/hex.hpp"

namespace fencepost::emulate {
namespace {

TEST(Messages, SayWhatTheBytesMean) {
  using test::hex;
  EXPECT_EQ(hex_of(hex("AE C1 0E 00")), "AE C1 0E 00");
  EXPECT_EQ(hex_of(hex("AE C1 0E 00"), 2), "AE C1 ...");
  EXPECT_EQ(describe_pixy2(true, hex("AE C1 20 02 FF FF")), "getBlocks");
  EXPECT_EQ(describe_pixy2(false, hex("AF C1 03 01 FE 00 FE")), "error busy: no new frame");
  EXPECT_EQ(describe_pixy2(false, hex("AF C1 21 00 00 00")), "0 blocks");
  EXPECT_EQ(describe_text(true, hex("47 56 0D")), "\"GV\\r\"");
  EXPECT_EQ(describe_create(true, hex("80 94 02 2B 2C")), "start, stream");
  EXPECT_EQ(describe_nxt(true, hex("03 00 00 06 01")), "get output state");
  EXPECT_EQ(describe_nxt(false, hex("03 00 02 05 C0")), "set input mode: out of range");
  EXPECT_EQ(describe_nxtcam5(true, hex("55 AA 01 03 45 48")), "command 'E'");
  EXPECT_EQ(describe_nxtcam5(false, hex("55 AA 07 04 02 00 02 3C 28 52 47 0B")), "1 blob");
  EXPECT_EQ(describe_avrcam(false, hex("0A 02 02 3C 28 50 46")), "2 objects");
}

}  // namespace
}  // namespace fencepost::emulate
