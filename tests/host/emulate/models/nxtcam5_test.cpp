// Golden bytes of the protocol's description, from the device's side.
#include "host/emulate/models/nxtcam5.hpp"

#include <gtest/gtest.h>

#include "tests/drivers/hex.hpp"

namespace fencepost::emulate {
namespace {

using test::hex;

constexpr base::Time kNxtcam5Up{15'000};
const sensor::Blob kBlob{2, 60, 40, 81, 70, {}, {}, 0, {}};

std::vector<std::uint8_t> answer(NxtCam5& device, const std::vector<std::uint8_t>& question,
                                 base::Time now = kNxtcam5Up) {
  std::vector<std::uint8_t> all;
  for (const std::uint8_t byte : question) {
    const auto part = device.take(byte, now);
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

// 0x55 + 0xAA + 0 + 1 = 0x100; with 4 bytes 0x104, + "5.01" = 0x35 + 0x2E + 0x30 + 0x31 = 0xC4.
TEST(EmulatedNxtCam5, TellsItsVersion) {
  NxtCam5 device(base::Time{});
  EXPECT_EQ(answer(device, hex("55 AA 00 01 00")), hex("55 AA 04 01 35 2E 30 31 C8"));
  EXPECT_EQ(answer(device, hex("55 AA 00 01 01")), hex("")) << "a wrong checksum";
  EXPECT_EQ(answer(device, hex("00 55 00 55 AA 09 01 02")), hex("")) << "noise, and more data than a command has";
  EXPECT_EQ(answer(device, hex("55 AA 00 01 00")), hex("55 AA 04 01 35 2E 30 31 C8"));
}

// 0xFF + 7 + 4 = 0x10A; 1 + 0 + 2 + 60 + 40 + 82 + 71 = 0x100.
TEST(EmulatedNxtCam5, SendsBlobsOnceToldToTrack) {
  NxtCam5 device(base::Time{});
  EXPECT_TRUE(device.image({kBlob}, kNxtcam5Up).empty());
  device.restart(base::Time{});
  answer(device, hex("55 AA 01 03 45 48"));
  EXPECT_TRUE(device.tracking());
  EXPECT_EQ(device.image({kBlob}, kNxtcam5Up), hex("55 AA 07 04 02 00 02 3C 28 52 47 0B"));
  EXPECT_TRUE(device.image({}, kNxtcam5Up).empty());
  device.restart(kNxtcam5Up);
  EXPECT_FALSE(device.tracking());
  EXPECT_EQ(answer(device, hex("55 AA 00 01 00"), kNxtcam5Up), hex("")) << "it starts";
}

TEST(EmulatedNxtCam5, MayBeDeafAndTrackFromTheStart) {
  NxtCam5 device(base::Time{});
  device.set_answers(false);
  EXPECT_EQ(answer(device, hex("55 AA 00 01 00")), hex(""));
  EXPECT_EQ(device.image({kBlob}, kNxtcam5Up), hex("55 AA 07 04 01 00 02 3C 28 52 47 0A"));
}

}  // namespace
}  // namespace fencepost::emulate
