// The append log of settings, and what a power cut leaves of it.
#include "firmware/config/settings_store.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "hal/fake/cut_flash.hpp"

namespace fencepost::config {
namespace {

using Flash = fake::CutFlash<256>;
using Lines = std::vector<std::string>;

Lines loaded(SettingsStore<Flash>& store) {
  Lines lines;
  store.load([&](std::string_view line) { lines.emplace_back(line); });
  return lines;
}
Lines loaded(Flash& flash) {
  SettingsStore<Flash> store(flash);
  return loaded(store);
}

bool append(SettingsStore<Flash>& store, const Lines& lines) {
  return store.append([&](auto& put) {
    for (const std::string& line : lines) put(line);
  });
}
bool rewrite(SettingsStore<Flash>& store, const Lines& lines) {
  return store.rewrite([&](auto& put) {
    for (const std::string& line : lines) put(line);
  });
}

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

// A page is told anew line by line, as before there were lines that belong together: it counts by its head.
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

// At every word of a long life the power is cut; afterwards each value is the last or, of the change that was being
// written, the one before. Then the robot goes on.
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

// The same with changes of one to three values at once, in the page and in pages told anew: all are as they were before
// or all as after; and none of those that did not count comes back with a later one.
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

}  // namespace
}  // namespace fencepost::config
