#include "host/recorder/typed_line.hpp"

#include <gtest/gtest.h>

#include <string_view>
#include <vector>

namespace fencepost::host {
namespace {

std::vector<std::string> lines_of(TypedLine& line, std::string_view keys) {
  std::vector<std::string> lines;
  for (const char key : keys) {
    if (const auto done = line.push(key)) lines.push_back(*done);
  }
  return lines;
}

using Lines = std::vector<std::string>;

TEST(TypedLine, EnterEndsIt) {
  TypedLine line;
  EXPECT_EQ(lines_of(line, "mode log\rstatus\n\rhe"), (Lines{"mode log", "status", ""}));
  EXPECT_EQ(line.text(), "he");
}

TEST(TypedLine, BackspaceTakesAWholeCharacter) {
  TypedLine line;
  EXPECT_EQ(lines_of(line, "x\xC3\xA9\x7F\by\x7F\x7F\x7Fok\r"), Lines{"ok"});
  EXPECT_EQ(lines_of(line, "a\xE2\x82\xAC\x7F\r"), Lines{"a"});
}

TEST(TypedLine, CtrlUForgetsIt) {
  TypedLine line;
  EXPECT_EQ(lines_of(line, "nonsense\x15mode text\r"), Lines{"mode text"});
}

TEST(TypedLine, CursorAndControlKeysArePassedOver) {
  TypedLine line;
  EXPECT_EQ(lines_of(line, "a\x1b[Ab\x1bOPc\x1b[15~d\x01\te\r"), Lines{"abcde"});
}

TEST(TypedLine, IsBounded) {
  TypedLine line;
  EXPECT_EQ(lines_of(line, std::string(5000, 'x') + "\r"), Lines{std::string(TypedLine::kLongest, 'x')});
}

}  // namespace
}  // namespace fencepost::host
