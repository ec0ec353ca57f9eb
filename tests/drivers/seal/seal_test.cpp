#include "tests/drivers/seal/seal.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/drivers/hex.hpp"

namespace fencepost::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

using test::sealed;
std::string sealed(std::string_view text, Seal seal) {
  const Bytes bytes = sealed(bytes_of(text), seal);
  return {bytes.begin(), bytes.end()};
}

// The protocols' own examples, their checksums zeroed.
TEST(Seal, WritesTheChecksumsOfTheExamples) {
  EXPECT_EQ(sealed(hex("13 06 2B 03 E8 2C FF DC 00"), seal_create), hex("13 06 2B 03 E8 2C FF DC DD"));
  EXPECT_EQ(sealed(hex("55 AA 11 0A 29 01 00 01 00 08 00 00 00 00 00 00"), seal_huskylens),
            hex("55 AA 11 0A 29 01 00 01 00 08 00 00 00 00 00 4D"));
  EXPECT_EQ(sealed(hex("55 AA 20 00 0A 00 00 00 00 00 00 00 00 00 00 00"), seal_huskylens),
            hex("55 AA 20 00 0A 00 00 00 00 00 00 00 00 00 00 29"));
  EXPECT_EQ(sealed(hex("55 AA 07 04 11 00 02 64 3C 8C 5A 00"), seal_nxtcam5),
            hex("55 AA 07 04 11 00 02 64 3C 8C 5A A3"));
  EXPECT_EQ(sealed(hex("55 AA 00 00 01 00 A0 00 64 00 28 00 1E 00"), seal_pixy1),
            hex("55 AA 4B 01 01 00 A0 00 64 00 28 00 1E 00"));
  EXPECT_EQ(sealed(hex("AF C1 20 02 00 00 FF FF"), seal_pixy2), hex("AF C1 20 02 FE 01 FF FF"));
  EXPECT_EQ(sealed("$F 1234 1*00\n$E 1234*00\r\n", seal_xbc), "$F 1234 1*73\n$E 1234*61\r\n");
  // CRC-16/CCITT-FALSE of 123456789 is 29B1 in every list of them.
  EXPECT_EQ(sealed("$123456789*0000\r\n", seal_records), "$123456789*29B1\r\n");
}

TEST(Seal, FindsMessagesBehindGarbageAndBehindEachOther) {
  EXPECT_EQ(sealed(hex("00 AF C1 20 02 00 00 FF FF AF AF C1 20 01 00 00 07"), seal_pixy2),
            hex("00 AF C1 20 02 FE 01 FF FF AF AF C1 20 01 07 00 07"));
  EXPECT_EQ(sealed("xx\nyy$123456789*0000", seal_records), "xx\nyy$123456789*29B1");
  EXPECT_EQ(sealed(hex("55 AA 55 AA 00 00 01 00 A0 00 64 00 28 00 1E 00"), seal_pixy1),
            hex("55 AA 55 AA 4B 01 01 00 A0 00 64 00 28 00 1E 00"))
      << "the first is an image's mark";
}

TEST(Seal, LeavesWhatIsCutOff) {
  for (const auto& [text, seal] :
       std::initializer_list<std::pair<std::string_view, Seal>>{{"AF C1 20 02 00 00 FF", seal_pixy2},
                                                                {"AF C1 20", seal_pixy2},
                                                                {"55 AA 11 0A 29 01", seal_huskylens},
                                                                {"55 AA 11", seal_huskylens},
                                                                {"55 AA 07 04 11", seal_nxtcam5},
                                                                {"55 AA", seal_nxtcam5},
                                                                {"13 06 2B 03", seal_create},
                                                                {"13 06", seal_create},
                                                                {"55 AA 00 00 01 00", seal_pixy1},
                                                                {"24 2A 30", seal_xbc},
                                                                {"24 2A 30 30 30", seal_records}}) {
    EXPECT_EQ(sealed(hex(text), seal), hex(text)) << text;
  }
  EXPECT_TRUE(sealed(Bytes{}, seal_records).empty());
}

}  // namespace
}  // namespace fencepost::test
