#include "host/emulate/models/frames.hpp"

#include <gtest/gtest.h>

namespace fencepost::emulate {
namespace {

std::string said(const Bytes& bytes) { return {bytes.begin(), bytes.end()}; }

// The checksums are CRC-16/CCITT-FALSE of the text between $ and *, by another program (binascii.crc_hqx).
TEST(FramePrinter, PrintsLines) {
  FramePrinter camera(true);
  FramePrinter without(false);
  (void)camera.power_up({});
  (void)without.power_up({});
  sensor::BlobFrame frame;
  EXPECT_EQ(said(camera.see(frame, base::Time{} + base::milliseconds(1'999))), "") << "it starts";
  const base::Time ready = base::Time{} + FramePrinter::kStart;
  EXPECT_EQ(said(camera.see(frame, ready)), "$FPFRM,2.0000,1,0*5102\r\n");
  (void)frame.blobs.push_back({2, 168, 66, 231, 113, {2'004}, {895}, 2'500, {}});
  EXPECT_EQ(said(camera.see(frame, ready)), "$FPFRM,2.0000,2,1,2,168,66,231,113,200.4,89.5,2500,*F016\r\n");
  EXPECT_EQ(said(without.see(frame, ready)), "$FPFRM,2.0000,1,1,2,168,66,231,113,199.5,89.5,0,*A1AF\r\n");
}

}  // namespace
}  // namespace fencepost::emulate
