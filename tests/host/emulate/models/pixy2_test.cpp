// Golden bytes of the protocol's description, from the device's side.
#include "host/emulate/models/pixy2.hpp"

#include <gtest/gtest.h>

#include "host/emulate/models/pixy2_usb.hpp"
#include "tests/drivers/hex.hpp"

namespace fencepost::emulate {
namespace {

using test::hex;
using Bytes = std::vector<std::uint8_t>;

constexpr base::Time kPixy2Up{100'000};

template <class Device>
Bytes ask(Device& device, const Bytes& request, base::Time now = kPixy2Up) {
  Bytes answer;
  for (const std::uint8_t byte : request) {
    for (const std::uint8_t out : device.take(byte, now)) answer.push_back(out);
  }
  return answer;
}

const sensor::Blob kFirst{1, 138, 89, 177, 119, {}, {}, 0, {}};
const sensor::Blob kSecond{2, 44, 55, 55, 65, {}, {}, 0, {}};

struct EmulatedPixy2 : testing::Test {
  Pixy2 device{base::Time{}};
};

TEST_F(EmulatedPixy2, AnswersAsDocumented) {
  EXPECT_EQ(ask(device, hex("AE C1 0E 00")), hex("AF C1 0F 10 17 03 00 22 03 00 14 00 67 65 6E 65 72 61 6C 00 00 00"));
  EXPECT_EQ(ask(device, hex("AE C1 0C 01 00")), hex("AF C1 0D 04 0D 01 3C 01 D0 00"));
  device.show({});
  EXPECT_EQ(ask(device, hex("AE C1 20 02 FF FF")), hex("AF C1 21 00 00 00"));
  EXPECT_EQ(ask(device, hex("AE C1 20 02 FF FF")), hex("AF C1 03 01 FE 00 FE"));
  EXPECT_EQ(ask(device, hex("AE C1 20 02 00 FF")), hex("AF C1 03 01 FD 00 FD"));
  EXPECT_EQ(ask(device, hex("AE C1 55 00")), hex("AF C1 03 01 FC 00 FC"));
  EXPECT_EQ(ask(device, hex("AE C1 14 03 01 02 03")), hex("AF C1 01 04 00 00 00 00 00 00"));
  EXPECT_EQ(device.not_emulated(), (std::vector<std::string>{"request 55", "LED"}));
}

TEST_F(EmulatedPixy2, SendsBlocksAsDocumented) {
  device.show({kSecond, kFirst});
  EXPECT_EQ(ask(device, hex("AF C1 20 02 FE 01 FF FF")),
            hex("AF C1 21 1C D4 01 01 00 9E 00 68 00 28 00 1E 00 00 00 01 00 "
                "02 00 32 00 3C 00 0C 00 0A 00 00 00 00 00"));
  device.show({kSecond, kFirst});
  EXPECT_EQ(ask(device, hex("AE C1 20 02 02 08")).at(3), 14);  // signature 2 only
  device.show({kSecond, kFirst});
  EXPECT_EQ(ask(device, hex("AE C1 20 02 FF 01")).at(6), 1);  // the largest only
}

/// Index and age of each block, the largest first.
std::vector<std::pair<int, int>> told(Pixy2& device) {
  const Bytes answer = ask(device, hex("AE C1 20 02 FF FF"));
  std::vector<std::pair<int, int>> list;
  for (std::size_t at = 6; at + 14 <= answer.size(); at += 14) list.emplace_back(answer[at + 12], answer[at + 13]);
  return list;
}
std::vector<std::pair<int, int>> tracked(Pixy2& device, const std::vector<sensor::Blob>& blobs) {
  device.show(blobs);
  return told(device);
}

// As tracker.h and blobs.cpp of the firmware: 24 ms trailing, images 16.4 ms apart.
TEST_F(EmulatedPixy2, RepeatsALostBlockForTwoImages) {
  using List = std::vector<std::pair<int, int>>;
  const auto seen = [&](const std::vector<sensor::Blob>& blobs) {
    device.see(blobs);
    return told(device);
  };
  EXPECT_EQ(seen({kFirst}), (List{{0, 0}}));
  EXPECT_EQ(seen({}), (List{{0, 1}}));
  EXPECT_EQ(seen({}), (List{{0, 2}}));
  EXPECT_EQ(seen({kFirst}), (List{{0, 3}})) << "back in time, it is the same";
  EXPECT_EQ(seen({kSecond}), (List{{0, 4}, {1, 0}}));
  EXPECT_EQ(seen({kSecond}), (List{{0, 5}, {1, 1}}));
  EXPECT_EQ(seen({kSecond}), (List{{1, 2}}));
  EXPECT_EQ(seen({kFirst, kSecond}), (List{{2, 0}, {1, 3}})) << "given up before: another";
}

TEST_F(EmulatedPixy2, TracksBlobsThatAreNear) {
  using List = std::vector<std::pair<int, int>>;
  const auto at = [](std::int16_t x, std::uint8_t signature = 1, std::int16_t low = 60) {
    return sensor::Blob{signature, x, 50, static_cast<std::int16_t>(x + 20), low, {}, {}, 0, {}};
  };
  EXPECT_EQ(tracked(device, {at(100), at(150, 1, 59)}), (List{{0, 0}, {1, 0}}));
  EXPECT_EQ(tracked(device, {at(140), at(110, 1, 59)}), (List{{1, 1}, {0, 1}})) << "each takes the nearer one";
  EXPECT_EQ(tracked(device, {at(110, 2), at(140, 1, 59)}), (List{{2, 0}, {1, 2}})) << "another colour";
  EXPECT_EQ(tracked(device, {at(231, 1), at(110, 2, 59)}), (List{{1, 3}, {2, 1}})) << "91 px";
  EXPECT_EQ(tracked(device, {at(138, 1), at(110, 2, 59)}), (List{{3, 0}, {2, 2}})) << "93 px: too far";
  EXPECT_EQ(tracked(device, {}), List{});
  EXPECT_EQ(tracked(device, {at(138, 1)}), (List{{4, 0}})) << "lost for a frame";
  for (int i = 0; i < 300; ++i) static_cast<void>(tracked(device, {at(138, 1)}));
  EXPECT_EQ(tracked(device, {at(138, 1)}), (List{{4, 255}}));
}

TEST_F(EmulatedPixy2, DropsDamagedRequestsAndStartsSlowly) {
  EXPECT_TRUE(ask(device, hex("AF C1 20 02 FE 02 FF FF")).empty());
  EXPECT_EQ(ask(device, hex("AF C1 0E 00 00 00"), base::Time{10'000}), hex("AF C1 03 01 FE 00 FE"));
  EXPECT_TRUE(ask(device, hex("AF C1 0E 00 00 00"), base::Time{4'000}).empty());
}

TEST_F(EmulatedPixy2, SpeaksChirpAsDocumented) {
  Pixy2Usb usb(device);
  Bytes init = hex("55 55 AA AA A1 00 00 00 06 00 00 00 02 02 40 00 01 01");
  init.resize(64, 0);
  Bytes answer = ask(usb, init);
  ASSERT_EQ(answer.size(), 64U);
  answer.resize(18);
  EXPECT_EQ(answer, hex("55 55 AA AA 61 00 00 00 06 00 00 00 00 00 00 00 01 01"));
}

// As the firmware does: a host that only ever asks for blocks gets them though another program ran.
TEST_F(EmulatedPixy2, ChangesProgramWhenAskedForBlocks) {
  device.set_default_program("line_tracking");
  EXPECT_EQ(ask(device, hex("AE C1 20 02 FF FF")), hex("AF C1 03 01 FA 00 FA"));
  EXPECT_EQ(ask(device, hex("AE C1 20 02 FF FF"), kPixy2Up + base::milliseconds(79)), hex("AF C1 03 01 FA 00 FA"));
  device.show({});
  EXPECT_EQ(ask(device, hex("AE C1 20 02 FF FF"), kPixy2Up + base::milliseconds(80)), hex("AF C1 21 00 00 00"));
}

// A host that asks for the resolution as soon as the program is said to run must get that program's.
TEST_F(EmulatedPixy2, SaysThatAProgramRunsOnceItDoes) {
  const auto line = hex("AE C1 02 0D 6C 69 6E 65 5F 74 72 61 63 6B 69 6E 67");  // "line_tracking"
  EXPECT_EQ(ask(device, line), hex("AF C1 01 04 00 00 00 00 00 00"));
  EXPECT_EQ(ask(device, line, kPixy2Up + base::milliseconds(79)), hex("AF C1 01 04 00 00 00 00 00 00"));
  EXPECT_EQ(ask(device, hex("AE C1 0C 01 00"), kPixy2Up + base::milliseconds(79)), hex("AF C1 03 01 FA 00 FA"));
  EXPECT_EQ(ask(device, line, kPixy2Up + base::milliseconds(80)), hex("AF C1 01 04 01 00 01 00 00 00"));
  EXPECT_EQ(ask(device, hex("AE C1 0C 01 00"), kPixy2Up + base::milliseconds(80)),
            hex("AF C1 0D 04 83 00 4F 00 34 00"));
  EXPECT_EQ(ask(device, hex("AE C1 18 00")), hex("AF C1 01 04 3D 00 3D 00 00 00")) << "61 a second";
}

}  // namespace
}  // namespace fencepost::emulate
