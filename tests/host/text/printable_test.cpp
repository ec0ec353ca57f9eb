#include "host/text/printable.hpp"

#include <gtest/gtest.h>

namespace fencepost::host {
namespace {

TEST(Printable, KeepsText) {
  EXPECT_EQ(printable(""), "");
  EXPECT_EQ(printable(" red box ~"), " red box ~");
  const std::string others = "\xC3\xA4 \xC4\x9B \xC2\xA0 \xE2\x82\xAC \xED\x9F\xBF \xF0\x9F\x90\xBF \xF4\x8F\xBF\xBF";
  EXPECT_EQ(printable(others), others) << "ä, ě (which has 0x9B in it), the first after C1, and up to the last of all";
}

TEST(Printable, ControlCharactersBecomeQuestionMarks) {
  EXPECT_EQ(printable("a\x1b[31mb\x1b]0;title\x07"), "a?[31mb?]0;title?");
  EXPECT_EQ(printable("one\nforged\r\t\x7f"), "one?forged???");
  EXPECT_EQ(printable(std::string_view("\0a", 2)), "?a");
}

// A terminal takes CSI as the byte 0x9B or as the character U+009B.
TEST(Printable, SoDoTheUpperControlCharacters) {
  EXPECT_EQ(printable("\x9B"
                      "31m"),
            "?31m");
  EXPECT_EQ(printable("\xC2\x9B"
                      "31m"),
            "??31m");
  EXPECT_EQ(printable("\xC2\x80\xC2\x9F\xC2\xA1"), "????\xC2\xA1");
}

TEST(Printable, BytesThatAreNoCharacterToo) {
  EXPECT_EQ(printable("\xE2\x82"), "??") << "cut off";
  EXPECT_EQ(printable("\xE2\x9B"
                      "A"),
            "??A")
      << "no last byte: an 8-bit terminal would take the second one for CSI";
  EXPECT_EQ(printable("\xE2\xE2\x82\xAC"), "?\xE2\x82\xAC");
  EXPECT_EQ(printable("\xC0\x9B \xE0\x80\x9B \xF0\x80\x80\x9B"), "?? ??? ????")
      << "ESC's kin in more bytes than needed";
  EXPECT_EQ(printable("\xED\xA0\x80 \xF4\x90\x80\x80 \xFF\xF8"), "??? ???? ??");
}

// "gol.exe" behind U+202E is shown as "exe.log".
TEST(Printable, NothingTurnsTheDirectionOfText) {
  EXPECT_EQ(printable("a\xE2\x80\xAEgol.exe"), "a???gol.exe");
  EXPECT_EQ(printable("\xE2\x80\xAA\xE2\x80\x8E\xE2\x80\x8F\xE2\x81\xA6\xE2\x81\xA9\xD8\x9C"), std::string(17, '?'));
  const std::string others = "\xE2\x80\x8D\xE2\x80\xA9\xE2\x80\xAF\xE2\x81\xA5\xE2\x81\xAA\xD7\xA9\xD8\x9B";
  EXPECT_EQ(printable(others), others) << "the characters beside them, and those of right-to-left scripts";
}

// A terminal's portion may end within a character.
TEST(PrintableBytes, ACharacterMayComeInTwoPortions) {
  PrintableBytes bytes;
  EXPECT_EQ(bytes.next('\xE2'), '\xE2');
  EXPECT_EQ(bytes.next('\x82'), '\x82');
  EXPECT_EQ(bytes.begun(), 2);
  EXPECT_EQ(bytes.next('\xAC'), '\xAC');
  EXPECT_EQ(bytes.begun(), 0);
  EXPECT_EQ(bytes.next('\xAC'), '?');
  EXPECT_EQ(bytes.broken_off(), 0);
}

}  // namespace
}  // namespace fencepost::host
