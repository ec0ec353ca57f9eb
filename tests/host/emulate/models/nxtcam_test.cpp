// Golden bytes of the protocol's description, from the device's side.
#include "host/emulate/models/nxtcam.hpp"

#include <gtest/gtest.h>

#include "tests/drivers/hex.hpp"

namespace fencepost::emulate {
namespace {

using test::hex;

constexpr base::Time kNxtcamUp{100'000};
const sensor::Blob kSecondBlob{2, 60, 40, 81, 70, {}, {}, 0, {}};
const sensor::Blob kFifth{5, 100, 100, 121, 130, {}, {}, 0, {}};

TEST(EmulatedNxtCam, KeepsObjectsInRegisters) {
  NxtCam device(base::Time{});
  device.show({kSecondBlob});
  EXPECT_EQ(device.transfer(1, hex("42"), 1, kNxtcamUp), hex("00"));  // not tracking yet
  EXPECT_TRUE(device.transfer(1, hex("41 45"), 0, kNxtcamUp));
  device.show({kSecondBlob, kFifth});
  EXPECT_EQ(device.transfer(1, hex("42"), 11, kNxtcamUp), hex("02 02 3C 28 50 46 05 64 64 78 82"));
  device.show({});
  EXPECT_EQ(device.transfer(1, hex("42"), 6, kNxtcamUp), hex("00 02 3C 28 50 46"));  // old data behind the count
  EXPECT_FALSE(device.transfer(2, hex("42"), 1, kNxtcamUp));
  EXPECT_FALSE(device.transfer(1, hex("42"), 1, base::Time{5'000}));
}

TEST(EmulatedNxtCam, SpeaksTheSerialDialect) {
  NxtCam device(base::Time{});
  std::vector<std::uint8_t> answer;
  for (const char c : std::string("ET\r")) answer = device.take(static_cast<std::uint8_t>(c), kNxtcamUp);
  EXPECT_EQ(answer, hex("41 43 4B 0D"));
  device.show({kSecondBlob, kFifth});
  EXPECT_EQ(device.packet(), hex("0A 02 02 3C 28 50 46 05 64 64 78 82 FF"));
  for (const char c : std::string("XX\r")) answer = device.take(static_cast<std::uint8_t>(c), kNxtcamUp);
  EXPECT_EQ(answer, hex("4E 43 4B 0D"));
}

std::vector<std::uint8_t> ask(NxtCam& device, const std::string& bytes) {
  std::vector<std::uint8_t> answers;
  for (const char c : bytes) {
    for (const std::uint8_t out : device.take(static_cast<std::uint8_t>(c), kNxtcamUp)) answers.push_back(out);
  }
  return answers;
}

// A host that ends lines with CR LF, and one that sends what lies behind its string as well.
TEST(EmulatedNxtCam, StoresNoOtherCharacters) {
  NxtCam device(base::Time{});
  EXPECT_EQ(ask(device, "PG\r\nPG\r\n"), hex("41 43 4B 0D 41 43 4B 0D"));
  EXPECT_EQ(ask(device, std::string("ET\r\n\0\x01%d\0", 9) + "DT\r"), hex("41 43 4B 0D 41 43 4B 0D"));
  EXPECT_FALSE(device.tracking());
  EXPECT_TRUE(device.not_emulated().empty());
}

TEST(EmulatedNxtCam, TakesAColourMap) {
  NxtCam device(base::Time{});
  std::string command = "SM";
  for (int i = 0; i < 48; ++i) command += " " + std::to_string(i + 100);
  EXPECT_EQ(ask(device, command + "\r\n"), hex("41 43 4B 0D"));
  EXPECT_TRUE(device.transfer(1, hex("41 47"), 0, kNxtcamUp));
  EXPECT_EQ(device.transfer(1, hex("80"), 3, kNxtcamUp), hex("64 65 66"));
  EXPECT_EQ(device.transfer(1, hex("AD"), 3, kNxtcamUp), hex("91 92 93"));
  EXPECT_EQ(ask(device, "SM 256\r"), hex("4E 43 4B 0D"));
  EXPECT_EQ(ask(device, "CR 18 44\rTL\rQQ\r"), hex("41 43 4B 0D 41 43 4B 0D 4E 43 4B 0D"));
  EXPECT_EQ(device.not_emulated(), (std::vector<std::string>{"CR", "TL", "QQ"}));
}

// 72 packets of two lines: 0B, the number, 176 bytes, 0F, which stands nowhere else but as a number.
TEST(EmulatedNxtCam, SendsItsPicture) {
  NxtCam device(base::Time{});
  device.show({kSecondBlob});  // columns 60 to 81, rows 40 to 70
  const std::vector<std::uint8_t> answer = ask(device, "DF\r\n");
  ASSERT_EQ(answer.size(), 4U + 72U * 179U);
  const auto at = [&](std::size_t packet, std::size_t i) { return answer[4 + 179 * packet + i]; };
  for (std::size_t packet = 0; packet < 72; ++packet) {
    EXPECT_EQ(at(packet, 0), 0x0B);
    EXPECT_EQ(at(packet, 1), packet);
    for (std::size_t i = 2; i < 178; ++i) EXPECT_NE(at(packet, i), 0x0F);
    EXPECT_EQ(at(packet, 178), 0x0F);
  }
  EXPECT_EQ(at(20, 2 + 59), 0x44);
  EXPECT_EQ(at(20, 2 + 60), 0xCC);
  EXPECT_EQ(at(35, 2 + 81), 0xC4) << "row 70 is light, row 71 is not";
  EXPECT_EQ(ask(device, "ET\rDF\r"), hex("41 43 4B 0D 41 43 4B 0D")) << "not while it tracks";
}

}  // namespace
}  // namespace fencepost::emulate
