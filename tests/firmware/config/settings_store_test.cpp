// The append log of settings, and what a power cut leaves of it.
#include "firmware/config/settings_store.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "hal/base/crc16.hpp"
#include "hal/fake/cut_flash.hpp"

namespace fencepost::config {
namespace {

using Flash = fake::CutFlash<256>;
using LargeFlash = fake::CutFlash<1024>;
using Lines = std::vector<std::string>;

template <class AnyFlash>
Lines loaded(SettingsStore<AnyFlash>& store) {
  Lines lines;
  store.load([&](std::string_view line) { lines.emplace_back(line); });
  return lines;
}
template <class AnyFlash>
Lines loaded(AnyFlash& flash) {
  SettingsStore<AnyFlash> store(flash);
  return loaded(store);
}

template <class AnyFlash>
bool append(SettingsStore<AnyFlash>& store, const Lines& lines) {
  return store.append([&](auto& put) {
    for (const std::string& line : lines) put(line);
  });
}
template <class AnyFlash>
bool rewrite(SettingsStore<AnyFlash>& store, const Lines& lines) {
  return store.rewrite([&](auto& put) {
    for (const std::string& line : lines) put(line);
  });
}

std::uint8_t test_byte(char c) { return static_cast<std::uint8_t>(c); }

/// A robot that keeps values by their first letters: append, and all of it anew where there is no room.
struct Robot {
  explicit Robot(Flash& flash) : store(flash) {
    store.load([this](std::string_view line) { values[line[0]] = line; });
  }
  bool set(char key, const std::string& value) { return set_together({key + value}); }
  bool set_together(const Lines& lines) {
    for (const std::string& line : lines) values[line[0]] = line;
    if (append(store, lines)) return true;
    Lines all;
    for (const auto& [name, line] : values) all.push_back(line);
    return rewrite(store, all);
  }
  SettingsStore<Flash> store;
  std::map<char, std::string> values;
};

TEST(SettingsStore, FreshFlashHoldsNothingAndTakesNoEntryBeforeItsFirstPage) {
  Flash flash;
  SettingsStore<Flash> store(flash);
  EXPECT_TRUE(loaded(store).empty());
  EXPECT_FALSE(append(store, {"a=1"}));
  EXPECT_TRUE(rewrite(store, {"a=1"}));
  EXPECT_TRUE(append(store, {"b=22"}));
  EXPECT_EQ(loaded(flash), (Lines{"a=1", "b=22"}));
  EXPECT_EQ(flash.erasures(), 0U);  // it was blank
}

TEST(SettingsStore, LayoutIsWhatTheHeaderSays) {
  Flash flash;
  SettingsStore<Flash> store(flash);
  static_cast<void>(loaded(store));
  ASSERT_TRUE(rewrite(store, {"123456789"}));
  const auto page = flash.page(0);
  // Sequence 1; length 9; the digits and three bytes of padding; CRC 29B1.
  const std::vector<std::uint8_t> expected = {0x01, 0x00, 0xFE, 0xFF, 0x09, 0x00, 0xF6, 0xFF, '1',  '2',  '3',  '4',
                                              '5',  '6',  '7',  '8',  '9',  0xFF, 0xFF, 0xFF, 0xB1, 0x29, 0x4E, 0xD6};
  EXPECT_EQ(std::vector<std::uint8_t>(page.begin(), page.begin() + 24), expected);
  EXPECT_EQ(page[24], 0xFF);
  // Of two that belong together, the first has its CRC 9D77 the other way round, the second its CRC as it is.
  ASSERT_TRUE(append(store, {"a", "123456789"}));
  const std::vector<std::uint8_t> together = {0x01, 0x00, 0xFE, 0xFF, 'a',  0xFF, 0xFF, 0xFF, 0x88, 0x62, 0x77,
                                              0x9D, 0x09, 0x00, 0xF6, 0xFF, '1',  '2',  '3',  '4',  '5',  '6',
                                              '7',  '8',  '9',  0xFF, 0xFF, 0xFF, 0xB1, 0x29, 0x4E, 0xD6};
  EXPECT_EQ(std::vector<std::uint8_t>(page.begin() + 24, page.begin() + 56), together);
  EXPECT_EQ(page[56], 0xFF);
}

// A rewritten page counts as a whole by its head, so each of its lines has its CRC as it is.
TEST(SettingsStore, LinesOfAPageToldAnewStandForThemselves) {
  Flash flash;
  SettingsStore<Flash> store(flash);
  static_cast<void>(loaded(store));
  ASSERT_TRUE(rewrite(store, {"a", "123456789"}));
  EXPECT_EQ(flash.page(0)[12], 0x77);  // CRC 9D77 of "a"
  EXPECT_EQ(flash.page(0)[13], 0x9D);
  EXPECT_EQ(loaded(flash), (Lines{"a", "123456789"}));
}

TEST(SettingsStore, FullPageGivesWayToTheOtherForEver) {
  Flash flash;
  Robot robot(flash);
  for (int i = 0; i < 200; ++i) {
    ASSERT_TRUE(robot.set(i % 2 == 0 ? 'a' : 'b', std::to_string(i))) << i;
    Robot again(flash);
    ASSERT_EQ(again.values, robot.values) << i;
  }
  EXPECT_GT(flash.erasures(), 5U);
}

TEST(SettingsStore, LineThatIsTooLongIsRefusedAndChangesNothing) {
  Flash flash;
  Robot robot(flash);
  ASSERT_TRUE(robot.set('a', "1"));
  EXPECT_FALSE(append(robot.store, {std::string(300, 'x')}));
  EXPECT_FALSE(append(robot.store, {"a2", std::string(230, 'x')}));  // nor the first of them
  EXPECT_FALSE(rewrite(robot.store, {std::string(250, 'x')}));       // fits no page of 256
  EXPECT_EQ(Robot(flash).values.at('a'), "a1");
  EXPECT_FALSE(append(robot.store, {"b1"}));  // which would count with what is left of the others
  ASSERT_TRUE(robot.set_together({"b1"}));
  EXPECT_EQ(Robot(flash).values.at('a'), "a1");
}

/// Whether the word that was being written is torn, or not begun.
class SettingsStoreCut : public testing::TestWithParam<bool> {};

// Cuts the power at every word of a long life. Afterwards each value is the last one; only the change that was being
// written may have left the value before it. Then the robot goes on.
TEST_P(SettingsStoreCut, AtAnyWordLosesAtMostTheChangeThatWasBeingWritten) {
  std::size_t cuts = 0;
  bool cut = true;
  for (std::size_t words = 0; cut; ++words) {
    Flash flash;
    Robot robot(flash);
    ASSERT_TRUE(robot.set('a', "first") && robot.set('b', "first"));
    flash.cut_after(words, GetParam());
    std::map<char, std::string> before = robot.values;
    cut = false;
    for (int i = 0; i < 60 && !cut; ++i) {
      before = robot.values;
      static_cast<void>(
          robot.set(i % 3 == 0 ? 'a' : 'b', std::string(static_cast<std::size_t>(i % 11), 'v') + std::to_string(i)));
      cut = flash.dead();
    }
    cuts += cut ? 1 : 0;
    flash.power_on();
    Robot again(flash);
    ASSERT_TRUE(again.values == before || again.values == robot.values) << "cut after " << words << " words";
    ASSERT_TRUE(again.set('a', "after") && again.set('b', "wards")) << "cut after " << words << " words";
    ASSERT_EQ(Robot(flash).values, again.values) << "cut after " << words << " words";
  }
  EXPECT_GT(cuts, 250U);
}

// The same with changes of one to three values at once, in a page and in rewritten pages. All values are as before the
// change, or all as after it. A change that did not count never comes back with a later one.
TEST_P(SettingsStoreCut, AtAnyWordLeavesValuesToldTogetherAllOldOrAllNew) {
  std::size_t cuts = 0;
  std::size_t old = 0;
  bool cut = true;
  for (std::size_t words = 0; cut; ++words) {
    Flash flash;
    Robot robot(flash);
    ASSERT_TRUE(robot.set_together({"afirst", "bfirst", "cfirst"}));
    flash.cut_after(words, GetParam());
    std::map<char, std::string> before = robot.values;
    cut = false;
    for (int i = 0; i < 40 && !cut; ++i) {
      before = robot.values;
      Lines lines = {"a" + std::to_string(i), "b" + std::string(static_cast<std::size_t>(i % 9), 'v'),
                     "c" + std::to_string(i * i)};
      lines.resize(static_cast<std::size_t>(1 + i % 3));
      static_cast<void>(robot.set_together(lines));
      cut = flash.dead();
    }
    cuts += cut ? 1U : 0U;
    flash.power_on();
    Robot again(flash);
    ASSERT_TRUE(again.values == before || again.values == robot.values) << "cut after " << words << " words";
    old += again.values == before ? 1U : 0U;
    ASSERT_TRUE(again.set('c', "after")) << "cut after " << words << " words";
    ASSERT_EQ(Robot(flash).values, again.values) << "cut after " << words << " words";
  }
  EXPECT_GT(cuts, 250U);
  EXPECT_GT(old, 250U);
}

INSTANTIATE_TEST_SUITE_P(Torn, SettingsStoreCut, testing::Bool());

TEST(SettingsStore, RubbishIsNoPage) {
  for (const int byte : {0x00, 0xA5, 0x7F}) {
    Flash flash;
    const std::vector<std::uint8_t> rubbish(256, static_cast<std::uint8_t>(byte));
    flash.program(0, 0, rubbish);
    flash.program(1, 0, rubbish);
    Robot robot(flash);
    EXPECT_TRUE(robot.values.empty());
    EXPECT_TRUE(robot.set('a', "1"));
    EXPECT_EQ(Robot(flash).values.at('a'), "a1");
  }
}

// A word of the page's head or of an entry: a number and its complement.
template <class AnyFlash>
void program_pair(AnyFlash& flash, std::size_t page, std::size_t at, unsigned value) {
  const std::array<std::uint8_t, 4> word = {static_cast<std::uint8_t>(value), static_cast<std::uint8_t>(value >> 8U),
                                            static_cast<std::uint8_t>(~value), static_cast<std::uint8_t>(~value >> 8U)};
  ASSERT_TRUE(flash.program(page, at, word));
}

// 256 bytes: a head of 4, and 252 for entries; of 8 each and their line.
TEST(SettingsStore, APageIsFilledToItsLastByteAndNoFurther) {
  Flash flash;
  SettingsStore<Flash> store(flash);
  static_cast<void>(loaded(store));
  EXPECT_EQ(store.room(), 0U) << "no page yet";
  ASSERT_TRUE(rewrite(store, {std::string(116, 'x')}));
  EXPECT_EQ(store.room(), 252U - 124U);
  ASSERT_TRUE(append(store, {std::string(112, 'y')}));
  EXPECT_EQ(store.room(), 8U);
  ASSERT_TRUE(append(store, {""})) << "an empty line is two words";
  EXPECT_EQ(store.room(), 0U);
  EXPECT_EQ(loaded(flash), (Lines{std::string(116, 'x'), std::string(112, 'y'), ""}));
  EXPECT_FALSE(append(store, {""}));

  Flash one;
  SettingsStore<Flash> whole(one);
  static_cast<void>(loaded(whole));
  EXPECT_FALSE(rewrite(whole, {std::string(245, 'x')})) << "padded to 248";
  EXPECT_EQ(flash.page(1)[0], 0xFF) << "nothing was written behind the page";
  EXPECT_TRUE(rewrite(whole, {std::string(244, 'x')}));
  EXPECT_EQ(loaded(one), Lines{std::string(244, 'x')});
  EXPECT_EQ(whole.room(), 0U);
}

TEST(SettingsStore, LinesOfEachLengthComeBack) {
  for (std::size_t length = 0; length <= 9; ++length) {
    Flash flash;
    SettingsStore<Flash> store(flash);
    static_cast<void>(loaded(store));
    const std::string line(length, '\0');
    ASSERT_TRUE(rewrite(store, {line, "end"})) << length;
    EXPECT_EQ(loaded(flash), (Lines{line, "end"})) << length;
    EXPECT_EQ(store.room(), 256U - 4U - (8U + (length + 3U) / 4U * 4U) - 12U) << length;
  }
}

TEST(SettingsStore, ALineHas256BytesAtMost) {
  LargeFlash flash;
  SettingsStore<LargeFlash> store(flash);
  static_cast<void>(loaded(store));
  EXPECT_FALSE(rewrite(store, {std::string(257, 'x')}));
  ASSERT_TRUE(rewrite(store, {std::string(256, 'x')}));
  EXPECT_FALSE(append(store, {std::string(257, 'y')}));
  EXPECT_EQ(loaded(flash), Lines{std::string(256, 'x')});
}

// An entry that another program wrote, right in all but its length.
TEST(SettingsStore, AnEntryThatIsTooLongEndsThePage) {
  for (const std::size_t length : {256U, 257U}) {
    LargeFlash flash;
    program_pair(flash, 0, 0, 1);
    program_pair(flash, 0, 4, static_cast<unsigned>(length));
    const std::string line(length, 'x');
    const std::size_t padded = (length + 3) / 4 * 4;
    std::vector<std::uint8_t> bytes(padded, 0xFF);
    std::copy(line.begin(), line.end(), bytes.begin());
    ASSERT_TRUE(flash.program(0, 8, bytes));
    program_pair(flash, 0, 8 + padded, base::crc16(line));
    SettingsStore<LargeFlash> store(flash);
    EXPECT_EQ(loaded(store), length == 256 ? Lines{line} : Lines{});
    EXPECT_EQ(append(store, {"a"}), length == 256) << "nothing is put behind what is none";
  }
}

TEST(SettingsStore, NothingIsPutIntoAPageThatIsNotBlank) {
  Flash flash;
  SettingsStore<Flash> store(flash);
  static_cast<void>(loaded(store));
  ASSERT_TRUE(rewrite(store, {"a1"}));
  ASSERT_TRUE(flash.program(0, 252, std::vector<std::uint8_t>{0xFF, 0xFF, 0xFF, 0xFE}));
  EXPECT_EQ(loaded(store), Lines{"a1"});
  EXPECT_EQ(store.room(), 0U);
  EXPECT_FALSE(append(store, {"b1"}));
  EXPECT_EQ(flash.page(0)[16], 0xFF) << "nor was it begun";
}

// The first of two that belong together, whole, and nothing behind it.
TEST(SettingsStore, NothingIsPutBehindABeginningThatIsLeft) {
  Flash flash;
  SettingsStore<Flash> store(flash);
  static_cast<void>(loaded(store));
  ASSERT_TRUE(rewrite(store, {"a1"}));
  program_pair(flash, 0, 16, 1);
  ASSERT_TRUE(flash.program(0, 20, std::vector<std::uint8_t>{'b', 0xFF, 0xFF, 0xFF}));
  program_pair(flash, 0, 24, static_cast<unsigned>(base::crc16("b") ^ 0xFFFFU));
  EXPECT_EQ(loaded(store), Lines{"a1"});
  EXPECT_EQ(store.room(), 0U);
  EXPECT_FALSE(append(store, {"c1"}));
}

// One worn-out word, that of the check of the first of two lines: the second must not be taken for a change of its own.
TEST(SettingsStore, AWordThatIsRefusedSpoilsTheWholeChange) {
  for (const std::size_t worn : {16U, 20U, 24U, 28U, 32U, 36U}) {
    Flash flash;
    SettingsStore<Flash> store(flash);
    static_cast<void>(loaded(store));
    ASSERT_TRUE(rewrite(store, {"a1"}));
    ASSERT_TRUE(flash.program(0, worn, std::vector<std::uint8_t>(4, 0x00)));
    EXPECT_FALSE(append(store, {"b", "c"})) << worn;
    EXPECT_EQ(store.room(), 0U) << worn;
    EXPECT_EQ(loaded(flash), Lines{"a1"}) << worn;
  }
}

TEST(SettingsStore, TheNewerPageCountsAcrossTheNumbersEnd) {
  const struct {
    unsigned first, second;
    const char* counts;
  } cases[] = {{1, 2, "two"}, {2, 1, "one"}, {0xFFFF, 0, "two"}, {0, 0xFFFF, "one"}, {7, 7, "one"}};
  for (const auto& [first, second, counts] : cases) {
    Flash flash;
    for (const std::size_t page : {0U, 1U}) {
      const std::string line = page == 0 ? "one" : "two";
      program_pair(flash, page, 0, page == 0 ? first : second);
      program_pair(flash, page, 4, 3);
      ASSERT_TRUE(flash.program(
          page, 8, std::vector<std::uint8_t>{test_byte(line[0]), test_byte(line[1]), test_byte(line[2]), 0xFF}));
      program_pair(flash, page, 12, base::crc16(line));
    }
    EXPECT_EQ(loaded(flash), Lines{counts}) << first << ' ' << second;
    SettingsStore<Flash> store(flash);
    static_cast<void>(loaded(store));
    ASSERT_TRUE(rewrite(store, {"new"}));
    EXPECT_EQ(loaded(flash), Lines{"new"}) << "its number is one more";
    EXPECT_EQ(flash.erasures(), 1U);
  }
}

// A single page counts, whatever its number is.
TEST(SettingsStore, APageAloneCounts) {
  for (const unsigned number : {1U, 0x7FFFU, 0x8001U, 0xFFF0U, 0U}) {
    for (const std::size_t page : {0U, 1U}) {
      Flash flash;
      program_pair(flash, page, 0, number);
      program_pair(flash, page, 4, 1);
      ASSERT_TRUE(flash.program(page, 8, std::vector<std::uint8_t>{'a', 0xFF, 0xFF, 0xFF}));
      program_pair(flash, page, 12, base::crc16("a"));
      EXPECT_EQ(loaded(flash), Lines{"a"}) << number << " in " << page;
    }
  }
}

TEST(SettingsStore, PagesWithoutRoomForAnEntryHoldNothing) {
  fake::CutFlash<4> flash;
  SettingsStore<fake::CutFlash<4>> store(flash);
  EXPECT_TRUE(loaded(store).empty());
  EXPECT_FALSE(rewrite(store, {}));
  EXPECT_EQ(flash.page(0)[0], 0xFF);
  fake::CutFlash<8> head_only;
  SettingsStore<fake::CutFlash<8>> small(head_only);
  EXPECT_TRUE(loaded(small).empty());
  EXPECT_TRUE(rewrite(small, {}));
  EXPECT_EQ(small.room(), 4U);
  EXPECT_TRUE(loaded(small).empty()) << "four bytes are no entry";
  EXPECT_EQ(small.room(), 4U);
}

}  // namespace
}  // namespace fencepost::config
