#include "drivers/nxtcam/serial.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/drivers/hex.hpp"

namespace fencepost::nxtcam {
namespace {

using test::bytes_of;
using test::hex;
using test::joined;
using Messages = std::vector<std::vector<std::uint8_t>>;

const char* const kTwo = "0A 02 02 3C 28 50 46 05 64 64 78 82 FF";
const char* const kV5 = "55 AA 07 04 11 00 02 64 3C 8C 5A A3";

template <std::size_t Size, auto Examine>
Messages heard(const std::vector<std::uint8_t>& bytes) {
  wire::Scanner<Size, Examine> scanner;
  Messages messages;
  for (const std::uint8_t byte : bytes) {
    scanner.feed(byte, {}, [&](auto message, base::Time) { messages.push_back(bytes_of(message)); });
  }
  return messages;
}
const auto avrcam = heard<kLongestTracking, examine_avrcam>;
const auto v5 = heard<kLongestV5, examine_v5>;

std::vector<std::uint8_t> typed(const std::string& text) { return {text.begin(), text.end()}; }

TEST(AvrCam, DocumentedPacket) {
  const Messages messages = avrcam(hex(kTwo));
  ASSERT_EQ(messages.size(), 1U);
  const auto frame = tracking_in(messages[0]);
  ASSERT_TRUE(frame);
  ASSERT_EQ(frame->blobs.size(), 2U);
  const sensor::Blob fifth{5, 100, 100, 121, 130, {1105}, {1150}, 0, {}};
  const sensor::Blob second{2, 60, 40, 81, 70, {705}, {550}, 0, {}};
  EXPECT_EQ(frame->blobs[1], fifth);
  EXPECT_EQ(frame->blobs[0], second);
  EXPECT_TRUE(tracking_in(hex("0A 00 FF"))->blobs.empty());
}

TEST(AvrCam, AnswersAreLines) {
  const Messages messages = avrcam(joined({typed("ACK\rAVRcam v1.4\r"), hex(kTwo), typed("NCK\r")}));
  ASSERT_EQ(messages.size(), 4U);
  EXPECT_EQ(line_in(messages[0]), "ACK");
  EXPECT_EQ(line_in(messages[1]), "AVRcam v1.4");
  EXPECT_EQ(line_in(messages[2]), "");
  EXPECT_EQ(line_in(messages[3]), "NCK");
  EXPECT_FALSE(tracking_in(messages[0]));
}

TEST(AvrCam, WhatItsFirstBytesAre) {
  const auto front = [](const std::vector<std::uint8_t>& bytes) { return examine_avrcam(bytes); };
  EXPECT_EQ(front(hex("0A")).front, wire::Front::kIncomplete);
  EXPECT_EQ(front(hex("0A 08")).front, wire::Front::kIncomplete);
  EXPECT_EQ(front(hex("0A 09")).front, wire::Front::kDamaged) << "eight objects at most";
  EXPECT_EQ(front(hex("0A 09")).size, 1U);
  EXPECT_EQ(front(hex("0A 00")).front, wire::Front::kIncomplete);
  EXPECT_EQ(front(hex("0A 00 FF")).size, 3U);
  EXPECT_EQ(front(hex("0A 00 FE")).front, wire::Front::kDamaged);
  // An impossible object (colour 8) is seen with its last byte, before the others come.
  EXPECT_EQ(front(hex("0A 02 08 3C 28 50")).front, wire::Front::kIncomplete);
  EXPECT_EQ(front(hex("0A 02 08 3C 28 50 46")).front, wire::Front::kDamaged);
  EXPECT_EQ(front(hex("0A 02 02 3C 28 50 46 08 64 64 78 82")).front, wire::Front::kDamaged) << "the second";
  EXPECT_EQ(front(hex("0A 02 02 3C 28 50 46 05 64 64 78 82")).front, wire::Front::kIncomplete);
  // Bytes that follow a message are none of its objects.
  const auto followed = front(joined({hex(kTwo), hex("FF FF FF FF FF FF FF FF")}));
  EXPECT_EQ(followed.front, wire::Front::kMessage);
  EXPECT_EQ(followed.size, hex(kTwo).size());
}

TEST(AvrCam, LinesHave32CharactersAtMost) {
  for (const std::size_t length : {1U, 32U, 33U}) {
    const std::string line(length, '~');
    const auto verdict = examine_avrcam(typed(line + "\r"));
    EXPECT_EQ(verdict.front, length <= 32 ? wire::Front::kMessage : wire::Front::kNoise) << length;
    EXPECT_EQ(verdict.size, length <= 32 ? length + 1 : 1U) << length;
  }
  EXPECT_EQ(examine_avrcam(typed(std::string(32, ' '))).front, wire::Front::kIncomplete);
  EXPECT_EQ(examine_avrcam(typed("ab\n")).size, 2U) << "up to what may begin a packet";
  EXPECT_EQ(examine_avrcam(hex("41 42 7F 0A")).size, 3U) << "with the byte that is no character";
  EXPECT_EQ(examine_avrcam(hex("1F 41")).size, 1U);
  EXPECT_EQ(examine_avrcam(hex("0D 41")).front, wire::Front::kNoise) << "an empty line";
  EXPECT_EQ(examine_avrcam(hex("0D 41")).size, 1U);
}

// Frame 17, colour 2, (100,60) to (140,90), both past the last pixel.
TEST(NxtCamV5, DocumentedBlob) {
  const Messages messages = v5(hex(kV5));
  ASSERT_EQ(messages.size(), 1U);
  const auto blob = v5_blob_in(messages[0]);
  ASSERT_TRUE(blob);
  EXPECT_EQ(blob->frame, 17);
  const sensor::Blob expected{2, 100, 60, 139, 89, {1195}, {745}, 0, {}};
  EXPECT_EQ(blob->blob, expected);
}

TEST(NxtCamV5, OtherTypesPassAndImpossibleBoxesDoNot) {
  EXPECT_FALSE(v5_blob_in(hex("55 AA 01 01 05 06")));
  EXPECT_EQ(v5(hex("55 AA 01 01 05 06")).size(), 1U);
  EXPECT_FALSE(v5_blob_in(hex("55 AA 07 04 11 00 02 8C 3C 64 5A 00")));
  EXPECT_FALSE(v5_blob_in(hex("55 AA 07 04 11 00 02 64 3C F1 5A 00")));
  EXPECT_TRUE(v5_blob_in(hex("55 AA 07 04 11 00 02 64 3C F0 A0 00")));
  EXPECT_FALSE(v5_blob_in(hex("55 AA 07 04 11 00 02 64 3C F0 A1 00")));
}

TEST(NxtCamV5, WhatItsFirstBytesAre) {
  const auto front = [](const char* bytes) { return examine_v5(hex(bytes)); };
  EXPECT_EQ(front("55").front, wire::Front::kIncomplete);
  EXPECT_EQ(front("55 AA").front, wire::Front::kIncomplete);
  EXPECT_EQ(front("55 AB").front, wire::Front::kNoise);
  EXPECT_EQ(front("54 AA 55").size, 2U) << "to what may begin a message";
  EXPECT_EQ(front("55 AB 01 55").size, 3U);
  EXPECT_EQ(front("55 AA 07").front, wire::Front::kIncomplete);
  EXPECT_EQ(front("55 AA 07 04").front, wire::Front::kIncomplete);
  EXPECT_EQ(front("55 AA 06 04").front, wire::Front::kDamaged) << "a blob has seven bytes";
  EXPECT_EQ(front("55 AA 08 04").front, wire::Front::kDamaged);
  const auto other = [&](std::size_t length) {
    return examine_v5(std::vector<std::uint8_t>{0x55, 0xAA, static_cast<std::uint8_t>(length), 0x01}).front;
  };
  EXPECT_EQ(other(kLongestV5 - 5), wire::Front::kIncomplete);
  EXPECT_EQ(other(kLongestV5 - 4), wire::Front::kDamaged) << "it would not fit";
  EXPECT_EQ(front("55 AA 00 01 00").size, 5U);
  EXPECT_EQ(front("55 AA 00 01 01").front, wire::Front::kDamaged) << "its sum";
}

TEST(NxtCamV5, BoxesAtTheEdges) {
  EXPECT_TRUE(v5_blob_in(hex("55 AA 07 04 11 00 02 00 00 01 01 00"))) << "a pixel";
  EXPECT_FALSE(v5_blob_in(hex("55 AA 07 04 11 00 02 00 00 01 00 00"))) << "no rows";
  EXPECT_FALSE(v5_blob_in(hex("55 AA 07 03 11 00 02 64 3C 8C 5A 00"))) << "another type";
  EXPECT_FALSE(v5_blob_in(hex("55 AA 08 04 11 00 02 64 3C 8C 5A 00 00")));
  const auto whole = v5_blob_in(hex("55 AA 07 04 11 00 02 00 00 F0 A0 00"));
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->blob, (sensor::Blob{2, 0, 0, 239, 159, {1'195}, {795}, 0, {}}));
}

TEST(NxtCamV5, ABoxUpsideDownIsNone) {
  EXPECT_FALSE(v5_blob_in(hex("55 AA 07 04 11 00 02 64 5A 8C 3C 00")));
  EXPECT_FALSE(v5_blob_in(hex("55 AA 07 04 11 00 02 64 3C 64 5A 00"))) << "no columns";
}

}  // namespace
}  // namespace fencepost::nxtcam
