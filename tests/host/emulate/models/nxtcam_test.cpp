// Golden bytes of the protocol's description, from the device's side.
#include "host/emulate/models/nxtcam.hpp"

#include <gtest/gtest.h>

#include "tests/drivers/hex.hpp"

namespace fencepost::emulate {
namespace {

using test::hex;

constexpr base::Time kReady{100'000};
const sensor::Blob kSecond{2, 60, 40, 81, 70, {}, {}, 0, {}};
const sensor::Blob kFifth{5, 100, 100, 121, 130, {}, {}, 0, {}};

TEST(EmulatedNxtCam, KeepsObjectsInRegisters) {
  NxtCam device(base::Time{});
  device.show({kSecond});
  EXPECT_EQ(device.transfer(1, hex("42"), 1, kReady), hex("00"));  // not tracking yet
  EXPECT_TRUE(device.transfer(1, hex("41 45"), 0, kReady));
  device.show({kSecond, kFifth});
  EXPECT_EQ(device.transfer(1, hex("42"), 11, kReady), hex("02 02 3C 28 50 46 05 64 64 78 82"));
  device.show({});
  EXPECT_EQ(device.transfer(1, hex("42"), 6, kReady), hex("00 02 3C 28 50 46"));  // old data behind the count
  EXPECT_FALSE(device.transfer(2, hex("42"), 1, kReady));
  EXPECT_FALSE(device.transfer(1, hex("42"), 1, base::Time{5'000}));
}

TEST(EmulatedNxtCam, SpeaksTheSerialDialect) {
  NxtCam device(base::Time{});
  std::vector<std::uint8_t> answer;
  for (const char c : std::string("ET\r")) answer = device.take(static_cast<std::uint8_t>(c), kReady);
  EXPECT_EQ(answer, hex("41 43 4B 0D"));
  device.show({kSecond, kFifth});
  EXPECT_EQ(device.packet(), hex("0A 02 02 3C 28 50 46 05 64 64 78 82 FF"));
  for (const char c : std::string("XX\r")) answer = device.take(static_cast<std::uint8_t>(c), kReady);
  EXPECT_EQ(answer, hex("4E 43 4B 0D"));
}

}  // namespace
}  // namespace fencepost::emulate
