#include "firmware/console/command.hpp"

#include <gtest/gtest.h>

#include <string>

namespace fencepost::test {
namespace {

using console::Answer;
using console::Reply;
using console::Verb;

std::string what_was_typed(std::string line) {
  const auto text = console::typed(line);
  return text ? std::string(*text) : "(not text)";
}

TEST(Typed, IsWhatTheOneWhoTypedSaw) {
  EXPECT_EQ(what_was_typed("status"), "status");
  EXPECT_EQ(what_was_typed("Status"), "status");
  EXPECT_EQ(what_was_typed("stst\b\batus"), "status");
  EXPECT_EQ(what_was_typed("x\x7f\x7fmap"), "map");
  EXPECT_EQ(what_was_typed("\x1b[Amap\x1b[3~\x1bOP"), "map");  // cursor up, delete, F1
  EXPECT_EQ(what_was_typed("map\x1b["), "map");
  EXPECT_EQ(what_was_typed("map\x1b"), "map");
}

TEST(Typed, NoiseBeforeALineIsNoPartOfIt) {
  using namespace std::string_literals;
  EXPECT_EQ(what_was_typed("\0\xff\x01status"s), "status");
  EXPECT_EQ(what_was_typed("sta\0tus"s), "status");
  EXPECT_EQ(what_was_typed("sta\xfftus"), "(not text)");  // might have been another word
  EXPECT_EQ(what_was_typed("\xff\xfe"), "");
}

TEST(Words, AreBetweenSpacesTabsAndEqualSigns) {
  const console::Words words = console::split("  set\talert.stop = 0.3 ");
  ASSERT_EQ(words.count, 3U);
  EXPECT_EQ(words.words[0], "set");
  EXPECT_EQ(words.words[1], "alert.stop");
  EXPECT_EQ(words.words[2], "0.3");
  EXPECT_EQ(console::split(" \t ").count, 0U);
  EXPECT_EQ(console::split("1 2 3 4 5 6 7").count, console::Words::kMax);
}

TEST(Check, EveryCommandWithTheWordsItNeeds) {
  for (const char* line : {"help", "status", "objects", "map", "alerts on", "alerts off", "mode text", "mode log",
                           "mode plot", "mode quiet", "set alert.stop 1", "set alert.stop 1 m", "get", "get alert.stop",
                           "selftest", "reset", "go", "stop", "version"}) {
    EXPECT_FALSE(console::check(console::split(line)).pending()) << line;
  }
}

TEST(Check, EachWayToBeWrong) {
  const auto reply = [](const char* line) { return console::check(console::split(line)).reply; };
  EXPECT_EQ(reply("frobnicate"), Reply::kNoSuchCommand);
  EXPECT_EQ(reply("set"), Reply::kTooFewWords);
  EXPECT_EQ(reply("set alert.stop"), Reply::kTooFewWords);
  EXPECT_EQ(reply("mode"), Reply::kTooFewWords);
  EXPECT_EQ(reply("alerts"), Reply::kTooFewWords);
  EXPECT_EQ(reply("alerts maybe"), Reply::kNoSuchWord);
  EXPECT_EQ(reply("mode loud"), Reply::kNoSuchWord);
  EXPECT_EQ(reply("map now"), Reply::kTooManyWords);
  EXPECT_EQ(reply("go 50"), Reply::kTooManyWords);
  EXPECT_EQ(reply("get alert.stop alert.warn"), Reply::kTooManyWords);
  EXPECT_EQ(reply("set alert.stop 1 s"), Reply::kTooManyWords);  // the unit is m
  EXPECT_EQ(reply("set confirm.k 1 m"), Reply::kTooManyWords);
  EXPECT_EQ(reply("set alert.stop 1 m please"), Reply::kTooManyWords);
}

std::string suggested(const char* word) {
  const Answer answer = console::check(console::split(word));
  if (answer.reply != Reply::kNoSuchCommand) return "(no error)";
  if (answer.subject == Answer::kNothingNear) return "";
  return std::string(console::info(static_cast<Verb>(answer.subject)).name);
}

TEST(Nearest, IsTheCommandThatWasMeant) {
  EXPECT_EQ(suggested("stats"), "status");
  EXPECT_EQ(suggested("sta"), "status");
  EXPECT_EQ(suggested("obj"), "objects");
  EXPECT_EQ(suggested("object"), "objects");
  EXPECT_EQ(suggested("hlep"), "help");
  EXPECT_EQ(suggested("alert"), "alerts");
  EXPECT_EQ(suggested("self-test"), "selftest");
  EXPECT_EQ(suggested("restet"), "reset");
  EXPECT_EQ(suggested("modes"), "mode");
  EXPECT_EQ(suggested("frobnicate"), "");
  // Two letters too many, too few or others, and three.
  for (const char* two : {"xxstatus", "statusxx", "stts", "atus", "xxatus", "statxx", "sxtatxus"})
    EXPECT_EQ(suggested(two), "status") << two;
  for (const char* three : {"xxxstatus", "statusxxx", "xxxtus", "xstatxusx"}) EXPECT_EQ(suggested(three), "") << three;
  EXPECT_EQ(suggested("x"), "");
  EXPECT_EQ(suggested("xy"), "");
  EXPECT_EQ(suggested(std::string(900, 'a').c_str()), "");
}

TEST(Nearest, IsTheSettingThatWasMeant) {
  const auto key = [](const char* word) -> std::string {
    const Answer answer = console::about_key(Reply::kOneSetting, Reply::kOneDevice, false, word);
    if (answer.reply == Reply::kOneSetting) return "(no error)";
    if (answer.subject == Answer::kNothingNear) return "";
    return std::string(config::kKeyInfo[answer.subject].name);
  };
  EXPECT_EQ(key("alert.stop"), "(no error)");
  EXPECT_EQ(key("alert.stp"), "alert.stop");
  EXPECT_EQ(key("stop"), "alert.stop");
  EXPECT_EQ(key("robot.with"), "robot.width");
  EXPECT_EQ(key("ttc_warn"), "alert.ttc_warn");
  EXPECT_EQ(key("colour"), "");
}

}  // namespace
}  // namespace fencepost::test
