#include "host/emulate/models/xbc.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace fencepost::emulate {
namespace {

TEST(EmulatedXbc, TheWorkedExample) {
  XbcDevice device;
  device.set_frame_number(1'234);
  const std::vector<XbcBlob> blobs = {{0, 0, 178, 146, 600, 160, 131, 196, 160, 0},
                                      {1, 0, 40, 200, 45, 37, 195, 43, 204, -785}};
  EXPECT_EQ(device.frame(blobs),
            "$F 1234 2*70\n"
            "$B 0 0 178 146 600 54 160 131 196 160 0*65\n"
            "$B 1 0 40 200 45 64 37 195 43 204 -785*49\n"
            "$E 1234*61\n");
  EXPECT_EQ(device.frame({}).substr(0, 10), "$F 1235 0*");
}

TEST(EmulatedXbc, TellsItsVersion) {
  XbcDevice device;
  EXPECT_EQ(device.feed("?\n"), "$V XBCL 1*72\n");
  EXPECT_EQ(device.feed("x\n"), "");
}

}  // namespace
}  // namespace fencepost::emulate
