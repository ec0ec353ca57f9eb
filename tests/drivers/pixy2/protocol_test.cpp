// The packets of the protocol's description, byte by byte.
#include "drivers/pixy2/protocol.hpp"

#include <gtest/gtest.h>

#include "tests/drivers/hex.hpp"

namespace fencepost::pixy2 {
namespace {

using test::bytes_of;
using test::hex;
using test::joined;

const char* const kVersionReply = "AF C1 0F 10 17 03 00 22 03 00 14 00 67 65 6E 65 72 61 6C 00 00 00";
const char* const kOneBlock = "AF C1 21 0E 6D 01 01 00 9E 00 68 00 28 00 1E 00 00 00 07 19";
const char* const kTwoBlocks =
    "AF C1 21 1C FA 02 01 00 9E 00 68 00 28 00 1E 00 00 00 07 19 02 00 32 00 3C 00 0C 00 0A 00 00 00 08 FF";
const char* const kColourCode = "AF C1 21 0E 4B 03 0A 00 C8 00 50 00 3C 00 14 00 D3 FF 03 04";
const char* const kNoBlocks = "AF C1 21 00 00 00";

struct Heard {
  std::vector<std::vector<std::uint8_t>> messages;
  std::vector<base::Time> times;
  std::uint32_t damaged = 0;
};

// One byte a tick, from tick 0 on.
Heard hear(const std::vector<std::uint8_t>& bytes) {
  wire::Scanner<kLongestPacket, examine> scanner;
  Heard heard;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    scanner.feed(bytes[i], base::Time{static_cast<std::int64_t>(i)}, [&](auto message, base::Time t) {
      heard.messages.push_back(bytes_of(message));
      heard.times.push_back(t);
    });
  }
  heard.damaged = scanner.damaged();
  return heard;
}

TEST(Pixy2Packets, RequestsAreTheDocumentedBytes) {
  EXPECT_EQ(bytes_of(request_version()), hex("AF C1 0E 00 00 00"));
  EXPECT_EQ(bytes_of(request_blocks(0xFF)), hex("AF C1 20 02 FE 01 FF FF"));
  EXPECT_EQ(bytes_of(request_resolution()), hex("AF C1 0C 01 00 00 00"));
  EXPECT_EQ(bytes_of(make_request(Type::kGetBlocks, std::array<std::uint8_t, 2>{1, 8})),
            hex("AF C1 20 02 09 00 01 08"));
}

TEST(Pixy2Packets, ProgramNameIsPaddedToThirtyThree) {
  const auto bytes = bytes_of(request_program());
  ASSERT_EQ(bytes.size(), 39U);
  EXPECT_EQ(bytes[2], 0x02);
  EXPECT_EQ(bytes[3], 33);
  EXPECT_EQ(std::string(bytes.begin() + 6, bytes.begin() + 32), "color_connected_components");
  EXPECT_EQ(bytes[32], 0);
  EXPECT_EQ(bytes[38], 0);
}

TEST(Pixy2Packets, EveryDocumentedReplyIsRead) {
  const auto version = version_in(packet_of(hex(kVersionReply)));
  ASSERT_TRUE(version);
  EXPECT_EQ(*version, (Version{0x2200, 3, 0, 20, "general"}));
  EXPECT_EQ(resolution_in(packet_of(hex("AF C1 0D 04 0D 01 3C 01 D0 00"))), (Resolution{316, 208}));
  EXPECT_EQ(error_in(packet_of(hex("AF C1 03 01 FE 00 FE"))), DeviceError::kBusy);
  EXPECT_EQ(error_in(packet_of(hex("AF C1 03 01 FD 00 FD"))), DeviceError::kInvalidRequest);
  EXPECT_EQ(error_in(packet_of(hex("AF C1 03 01 FC 00 FC"))), DeviceError::kUnsupported);
  EXPECT_EQ(result_in(packet_of(hex("AF C1 01 04 00 00 00 00 00 00"))), 0);
  EXPECT_EQ(result_in(packet_of(hex("AF C1 01 04 FC 03 FF FF FF FF"))), -1);
}

TEST(Pixy2Packets, RepliesOfAnotherTypeOrLengthAreNothing) {
  EXPECT_FALSE(version_in(packet_of(hex(kNoBlocks))));
  EXPECT_FALSE(version_in(packet_of(hex("AF C1 0F 01 17 00 17"))));
  EXPECT_FALSE(resolution_in(packet_of(hex("AF C1 0D 02 3D 00 3C 01"))));
  EXPECT_FALSE(result_in(packet_of(hex("AF C1 01 01 00 00 00"))));
  EXPECT_FALSE(error_in(packet_of(hex("AF C1 03 00 00 00"))));
  EXPECT_FALSE(blocks_in(packet_of(hex("AF C1 21 01 07 00 07"))));
}

// Centre 158, width 40: columns 138 up to and without 178. Centre 104, height 30: rows 89 to 119.
TEST(Pixy2Packets, BlocksBecomeInclusiveBoxes) {
  const auto blocks = blocks_in(packet_of(hex(kTwoBlocks)));
  ASSERT_TRUE(blocks);
  ASSERT_EQ(blocks->frame.blobs.size(), 2U);
  const sensor::Blob first{1, 138, 89, 177, 119, {1575}, {1040}, 0, {}, false, 8};
  const sensor::Blob second{2, 44, 55, 55, 65, {495}, {600}, 0, {}, false, 9};
  EXPECT_EQ(blocks->frame.blobs[0], first);
  EXPECT_EQ(blocks->frame.blobs[1], second);
  EXPECT_EQ(blocks->dropped, 0U);
  EXPECT_TRUE(blocks_in(packet_of(hex(kNoBlocks)))->frame.blobs.empty());
}

TEST(Pixy2Packets, ColourCodesKeepTheirOctalNumber) {
  const auto blocks = blocks_in(packet_of(hex(kColourCode)));
  ASSERT_TRUE(blocks);
  EXPECT_EQ(blocks->frame.blobs[0].signature, 012);
  const auto large = blocks_in(packet_of(hex("AF C1 21 0E 00 00 00 01 C8 00 50 00 3C 00 14 00 D3 FF 03 04")));
  ASSERT_TRUE(large);
  EXPECT_TRUE(large->frame.blobs.empty());
  EXPECT_EQ(large->dropped, 1U);
}

TEST(Pixy2Packets, EighteenBlocksAreSixteenLargestAndTwoDropped) {
  std::vector<std::uint8_t> packet = hex("AF C1 21 FC 00 00");
  for (int i = 1; i <= 18; ++i) {
    for (const int word : {1, 100, 100, 2 * i, 4, 0, 0}) {
      packet.push_back(static_cast<std::uint8_t>(word));
      packet.push_back(0);
    }
  }
  const auto blocks = blocks_in(packet_of(packet));
  ASSERT_TRUE(blocks);
  ASSERT_EQ(blocks->frame.blobs.size(), 16U);
  EXPECT_EQ(blocks->dropped, 2U);
  EXPECT_EQ(blocks->frame.blobs[0].x2 - blocks->frame.blobs[0].x1 + 1, 36);
  EXPECT_EQ(blocks->frame.blobs[15].x2 - blocks->frame.blobs[15].x1 + 1, 6);
}

TEST(Pixy2Packets, WhatTheirFirstBytesAre) {
  using wire::Front;
  const auto front = [](const char* text) { return examine(hex(text)).front; };
  EXPECT_EQ(front("AF"), Front::kIncomplete);
  EXPECT_EQ(front("AE"), Front::kNoise);
  EXPECT_EQ(front("AF C1"), Front::kIncomplete);
  EXPECT_EQ(front("AF C2"), Front::kNoise);
  EXPECT_EQ(front("AF C1 22"), Front::kIncomplete);
  EXPECT_EQ(front("AF C1 22 00"), Front::kDamaged) << "no reply is of that type";
  for (const char* possible :
       {"AF C1 01 04", "AF C1 0D 04", "AF C1 03 01", "AF C1 0F 10", "AF C1 21 00", "AF C1 21 0E", "AF C1 21 FC"}) {
    EXPECT_EQ(front(possible), Front::kIncomplete) << possible;
  }
  for (const char* impossible :
       {"AF C1 01 05", "AF C1 0D 03", "AF C1 03 02", "AF C1 0F 11", "AF C1 21 0F", "AF C1 21 0D"}) {
    EXPECT_EQ(front(impossible), Front::kDamaged) << impossible;
  }
  EXPECT_EQ(front("AF C1 21 00 00"), Front::kIncomplete);
  EXPECT_EQ(examine(hex("AF C1 21 00 00 00 AF")).size, 6U);
  EXPECT_EQ(front("AF C1 03 01 FE 00"), Front::kIncomplete);
  EXPECT_EQ(front("AF C1 03 01 FE 00 FE"), Front::kMessage);
  EXPECT_EQ(front("AF C1 03 01 FE 00 FD"), Front::kDamaged);
}

TEST(Pixy2Requests, WhatTheirFirstBytesAre) {
  using wire::Front;
  const auto front = [](const char* text) { return examine_request(hex(text)).front; };
  EXPECT_EQ(front("AF"), Front::kIncomplete);
  EXPECT_EQ(front("AF C1"), Front::kIncomplete);
  EXPECT_EQ(front("AF C2"), Front::kNoise) << "seen with the second byte";
  EXPECT_EQ(front("C1 AF"), Front::kNoise);
  EXPECT_EQ(front("AF C1 02 21"), Front::kIncomplete) << "the longest, with a name of 33";
  EXPECT_EQ(front("AF C1 02 22"), Front::kNoise);
  EXPECT_EQ(front("AF C1 0E 00 00"), Front::kIncomplete);
  EXPECT_EQ(examine_request(hex("AF C1 0E 00 00 00 AF")).size, 6U);
  EXPECT_EQ(front("AF C1 0C 01 00 00"), Front::kIncomplete);
  EXPECT_EQ(examine_request(hex("AF C1 0C 01 00 00 00")).size, 7U);
}

// Rows: centre 2, height 4 begins at 0; centre 205 ends at 207. Columns: centre 2, width 4; centre 314, ends at 315.
TEST(Pixy2Packets, BoxesThatTouchTheEdgesAreInside) {
  const auto inside = [](int x, int y, int width, int height, int signature = 1) {
    std::vector<std::uint8_t> packet = hex("AF C1 21 0E 00 00");
    for (const int word : {signature, x, y, width, height, 0, 0}) {
      packet.push_back(static_cast<std::uint8_t>(word & 0xFF));
      packet.push_back(static_cast<std::uint8_t>(word >> 8));
    }
    return blocks_in(packet_of(packet)).has_value();
  };
  EXPECT_TRUE(inside(2, 100, 4, 4));
  EXPECT_FALSE(inside(1, 100, 4, 4));
  EXPECT_TRUE(inside(314, 100, 4, 4));
  EXPECT_FALSE(inside(315, 100, 4, 4));
  EXPECT_TRUE(inside(100, 2, 4, 4));
  EXPECT_FALSE(inside(100, 1, 4, 4));
  EXPECT_TRUE(inside(100, 205, 4, 4));
  EXPECT_FALSE(inside(100, 206, 4, 4));
  EXPECT_TRUE(inside(100, 100, 1, 0)) << "one column, one row";
  EXPECT_FALSE(inside(100, 100, 0, 4));
  EXPECT_TRUE(inside(100, 100, 4, 4, 256)) << "counted, not rejected";
  EXPECT_FALSE(inside(100, 100, 4, 4, 0));
}

TEST(Pixy2Scanner, GivesEachPacketAndWhenItBegan) {
  const auto one = hex(kOneBlock);
  const Heard heard = hear(joined({hex(kVersionReply), one, hex(kNoBlocks)}));
  ASSERT_EQ(heard.messages.size(), 3U);
  EXPECT_EQ(heard.messages[1], one);
  EXPECT_EQ(heard.times[0], base::Time{0});
  EXPECT_EQ(heard.times[1], base::Time{22});
  EXPECT_EQ(heard.times[2], base::Time{42});
}

// A length of 252 that was 14: the bytes of the next packets are taken for data, then found again.
TEST(Pixy2Scanner, OverlongLengthGivesBackWhatItSwallowed) {
  auto bad = hex(kOneBlock);
  bad[3] = 0xFC;
  std::vector<std::uint8_t> bytes = bad;
  for (int i = 0; i < 14; ++i) bytes = joined({bytes, hex(kOneBlock)});
  const Heard heard = hear(bytes);
  EXPECT_EQ(heard.messages.size(), 14U);
  EXPECT_EQ(heard.damaged, 1U);
}

TEST(Pixy2Scanner, ImpossibleHeadersAreNotWaitedFor) {
  for (const char* header :
       {"AF C1 20 02", "AF C1 21 0F", "AF C1 01 05", "AF C1 03 02", "AF C1 0F 11", "AF C1 0D 00"}) {
    const Heard heard = hear(joined({hex(header), hex(kOneBlock)}));
    EXPECT_EQ(heard.messages.size(), 1U) << header;
    EXPECT_EQ(heard.damaged, 1U) << header;
  }
}

TEST(Pixy2Packets, PaddingComesFirst) {
  const auto bytes = bytes_of(behind_padding(request_version()));
  ASSERT_EQ(bytes.size(), 70U);
  EXPECT_EQ(bytes[0], 0x01);
  EXPECT_EQ(bytes[63], 0x01);
  EXPECT_EQ(std::vector<std::uint8_t>(bytes.begin() + 64, bytes.end()), hex("AF C1 0E 00 00 00"));
}

}  // namespace
}  // namespace fencepost::pixy2
