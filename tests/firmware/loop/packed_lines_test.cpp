#include "firmware/loop/packed_lines.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "firmware/loop/canned_stream.hpp"

namespace fencepost::test {
namespace {

std::vector<std::uint8_t> packed(std::string_view lines) {
  std::vector<std::uint8_t> bytes(loop::pack_lines(lines, {}));
  loop::pack_lines(lines, bytes);
  return bytes;
}

std::string unpacked(std::span<const std::uint8_t> bytes, std::size_t room = 112) {
  std::vector<char> line(room);
  std::string lines;
  std::uint16_t at = 0;
  for (std::string_view text = loop::unpack_line(bytes, at, line); !text.empty();
       text = loop::unpack_line(bytes, at, line)) {
    lines.append(text).append("\n");
  }
  return lines;
}

// 1 is code 1, ',' code 10; "$FPODO," is announced by 15, the seventh piece; '\n' is 14. The first is the lower half.
TEST(PackedLines, ACharacterIsFourBitsAndAPieceIsEight) {
  EXPECT_EQ(packed("1,\n"), (std::vector<std::uint8_t>{0xA1, 0x0E}));
  EXPECT_EQ(packed("$FPODO,9\n"), (std::vector<std::uint8_t>{0x6F, 0xE9}));
}

TEST(PackedLines, ComeBackAsTheyWere) {
  for (const std::string_view lines : {"1\n", "12\n-3.4,*\n", "$FPODO,0.0000,1.5*F47A\n7\n", "ABCDEF\n"}) {
    EXPECT_EQ(unpacked(packed(lines)), lines);
  }
}

TEST(PackedLines, TheCannedStreamIsWholeAndLessThanHalfAsLong) {
  EXPECT_EQ(unpacked(loop::kPackedLines, loop::kLongestCannedLine), loop::kCannedLines);
  EXPECT_LT(loop::kPackedLines.size(), loop::kCannedLines.size() / 2);
}

TEST(PackedLines, RefuseWhatHasNoCode) { EXPECT_EQ(loop::pack_lines("1,x\n", {}), 0U); }

TEST(PackedLines, EndWhereALineHasNoRoomOrNoEndOrACodeStandsForNothing) {
  EXPECT_EQ(unpacked(packed("123\n"), 3), "123\n");
  EXPECT_EQ(unpacked(packed("123\n"), 2), "");
  EXPECT_EQ(unpacked(packed("1\n23")), "1\n");
  EXPECT_EQ(unpacked(std::vector<std::uint8_t>{0xFF, 0x0E}), "");
  EXPECT_EQ(unpacked(packed("")), "");
}

}  // namespace
}  // namespace fencepost::test
