#include "host/text/wrap.hpp"

#include <gtest/gtest.h>

namespace fencepost::host {
namespace {

TEST(Wrap, LeavesWhatFits) {
  const std::string text = "Usage: fencepost run\n\nthe loop\n\nOptions:\n  -h,--help     this help\n";
  EXPECT_EQ(wrapped(text, 80), text);
  EXPECT_EQ(wrapped(text, 27), text) << "the longest line, to the letter";
  EXPECT_EQ(wrapped("", 80), "");
  EXPECT_EQ(wrapped("no line end", 80), "no line end");
}

TEST(Wrap, TextGoesOnInItsColumn) {
  EXPECT_EQ(wrapped("  --log FILE    the whole record stream\n", 32),
            "  --log FILE    the whole record\n"
            "                stream\n");
  EXPECT_EQ(wrapped("                at one, two, three\n", 32),
            "                at one, two,\n"
            "                three\n");
  EXPECT_EQ(wrapped("one two three four\n", 9), "one two\nthree\nfour\n");
}

TEST(Wrap, ANarrowTerminalHasItsTextBelow) {
  EXPECT_EQ(wrapped("  --log FILE    the record stream\n", 24),
            "  --log FILE\n"
            "      the record stream\n");
  EXPECT_EQ(wrapped("                at one, two, three\n", 20),
            "        at one, two,\n"
            "        three\n");
}

TEST(Wrap, CommandsGoOnBehindABackslash) {
  EXPECT_EQ(
      wrapped("Examples:\n  fencepost run --camera pixy2 --on-alert './motors \"$1\"' --wait\nlast words of it\n", 32),
      "Examples:\n"
      "  fencepost run --camera pixy2 \\\n"
      "      --on-alert \\\n"
      "      './motors \"$1\"' --wait\n"
      "last words of it\n");
}

TEST(Wrap, AWordIsNeverBroken) {
  EXPECT_EQ(wrapped("  pixy2  a-word-that-is-longer-than-any-line too\n", 20),
            "  pixy2  a-word-that-is-longer-than-any-line\n"
            "         too\n");
}

}  // namespace
}  // namespace fencepost::host
