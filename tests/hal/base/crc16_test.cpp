#include "hal/base/crc16.hpp"

#include <gtest/gtest.h>

#include <string>

namespace fencepost::base {
namespace {

TEST(Crc16, AnswersTheCatalogueCheckValue) { EXPECT_EQ(crc16("123456789"), 0x29B1); }

TEST(Crc16, OfNothingIsTheInitialValue) { EXPECT_EQ(crc16(""), 0xFFFF); }

// By hand: 0xFFFF ^ 0x4100 = 0xBEFF, then eight shifts, xor 0x1021 wherever the top bit falls out:
// 6DDF DBBE A75D 5E9B BD36 6A4D D49A B915.
TEST(Crc16, OfOneLetterMatchesTheHandWorkedShifts) { EXPECT_EQ(crc16("A"), 0xB915); }

TEST(Crc16, StepsAgreeWithTheWhole) {
  std::uint16_t crc = 0xFFFF;
  for (const char c : std::string("FPODO,1.0000,0.0000,0.0000,0.0000")) {
    crc = crc16_step(crc, static_cast<std::uint8_t>(c));
  }
  EXPECT_EQ(crc, crc16("FPODO,1.0000,0.0000,0.0000,0.0000"));
}

// Eight bytes at a time where there are tables: every length, and every byte at every place of the eight.
TEST(Crc16, IsThatOfItsBytesOneByOne) {
  std::string bytes;
  unsigned next = 1;
  for (int length = 0; length < 600; ++length) {
    std::uint16_t crc = 0xFFFF;
    for (const char c : bytes) crc = crc16_step(crc, static_cast<std::uint8_t>(c));
    ASSERT_EQ(crc16(bytes), crc) << "length " << length;
    next = next * 1'103'515'245U + 12'345U;
    bytes.push_back(static_cast<char>(next >> 16U));
  }
  for (unsigned byte = 0; byte < 256; ++byte) {
    std::string same(24, static_cast<char>(byte));
    std::uint16_t crc = 0xFFFF;
    for (const char c : same) crc = crc16_step(crc, static_cast<std::uint8_t>(c));
    ASSERT_EQ(crc16(same), crc) << "byte " << byte;
  }
}

TEST(Crc16, SeesEverySingleBitFlip) {
  const std::string line = "FPODO,1.0000,0.2500,-0.1000,3.1416";
  const std::uint16_t good = crc16(line);
  for (std::size_t i = 0; i < line.size(); ++i) {
    for (unsigned bit = 0; bit < 8; ++bit) {
      std::string bad = line;
      bad[i] = static_cast<char>(static_cast<unsigned char>(bad[i]) ^ (1U << bit));
      EXPECT_NE(crc16(bad), good) << "byte " << i << " bit " << bit;
    }
  }
}

TEST(Crc16, TakesBytesAboveAsciiAsUnsigned) {
  EXPECT_EQ(crc16("\xFF"), 0xFF00);  // 0xFFFF ^ 0xFF00 = 0x00FF, eight shifts without a carry: 0xFF00
}

}  // namespace
}  // namespace fencepost::base
