#include <gtest/gtest.h>

#include <cmath>

#include "host/report/alert_spans.hpp"
#include "host/report/label_space.hpp"
#include "host/report/map_frame.hpp"
#include "host/report/markup.hpp"
#include "host/report/palette.hpp"
#include "host/report/ticks.hpp"
#include "tests/host/report/scenes.hpp"

namespace fencepost::host {
namespace {

using testing::alert_at;

TEST(Escaped, LeavesNothingThatHtmlWouldRead) {
  EXPECT_EQ(markup::escaped("<a href=\"x\">'&"), "&lt;a href=&quot;x&quot;&gt;&#39;&amp;");
  EXPECT_EQ(markup::escaped("Grün \u2013 \U0001F916"), "Grün \u2013 \U0001F916");
}

TEST(Escaped, ReplacesWhatIsNotText) {
  const std::string r = "\uFFFD";
  EXPECT_EQ(markup::escaped(std::string("a\0b", 3)), "a" + r + "b");
  EXPECT_EQ(markup::escaped("\xC0\xAF"), r + r);          // overlong '/'
  EXPECT_EQ(markup::escaped("\xED\xA0\x80"), r + r + r);  // surrogate
  EXPECT_EQ(markup::escaped("x\xE2\x82"), "x" + r + r);   // cut short
}

TEST(Figure, IsForReading) {
  EXPECT_EQ(markup::figure(-1.25, 1), "\u22121.2");  // half to even in binary: 1.25 is exact
  EXPECT_EQ(markup::figure(-0.001, 2), "0.00");
  EXPECT_EQ(markup::figure(std::nan(""), 2), "\u2013");
  EXPECT_EQ(markup::px(-0.001), "0.00");
}

TEST(Ticks, AreRound) {
  EXPECT_DOUBLE_EQ(nice_step(0.13), 0.2);
  EXPECT_DOUBLE_EQ(nice_step(0.2), 0.2);
  EXPECT_DOUBLE_EQ(nice_step(6), 10);
  EXPECT_EQ(step_decimals(0.05), 2);
  EXPECT_EQ(step_decimals(20), 0);
  EXPECT_EQ(ticks(-0.25, 0.5, 0.25), (std::vector<double>{-0.25, 0, 0.25, 0.5}));
}

TEST(Ink, IsDarkEnoughForPaperAndKeepsDarkColours) {
  EXPECT_EQ(ink({0x10, 0x20, 0x30}, kLineLuminance), "#102030");
  const std::string yellow = ink({0xff, 0xff, 0x00}, kTextLuminance);
  EXPECT_NE(yellow, "#ffff00");
  EXPECT_EQ(yellow.substr(1, 2), yellow.substr(3, 2));  // same hue
  EXPECT_EQ(yellow.substr(5, 2), "00");
}

TEST(AlertSpans, ALevelHoldsUntilTheNextRecordOfItsObject) {
  using record::AlertLevel;
  ResultDocument d;
  d.path = {{0, 0, 0, 0}, {10, 0, 0, 0}};
  d.alerts = {alert_at(1, AlertLevel::kNotice, 1, 1, 0, 1, std::nullopt),
              alert_at(2, AlertLevel::kStop, 2, 1, 0, 1, std::nullopt),
              alert_at(3, AlertLevel::kNotice, 1, 1, 0, 1, std::nullopt),
              alert_at(4, AlertLevel::kClear, 1, 1, 0, 1, std::nullopt)};
  const auto all = alert_series(d);
  ASSERT_EQ(all.size(), 2U);
  ASSERT_EQ(all[0].spans.size(), 2U);  // the repeat at 3 s is the same span
  EXPECT_DOUBLE_EQ(all[0].spans[0].begin, 1);
  EXPECT_DOUBLE_EQ(all[0].spans[0].end, 4);
  EXPECT_DOUBLE_EQ(all[1].spans[0].end, 10);  // never cleared: to the end of the run
}

TEST(MapFrame, ShowsPathAndTruthWithEqualScales) {
  const MapFrame f = fit_map(testing::arc_document(), testing::two_object_scene());
  for (const PoseResult& pose : testing::arc_document().path) EXPECT_TRUE(f.shows({pose.x, pose.y}));
  EXPECT_GT(f.x(1), f.x(0));
  EXPECT_LT(f.y(1), f.y(0));  // y is up
  EXPECT_DOUBLE_EQ(f.x(1) - f.x(0), f.y(0) - f.y(1));
}

constexpr LabelSpace::Bounds kSheet{0, 0, 400, 300};

TEST(LabelSpace, MovesALabelOffAnother) {
  LabelSpace space(kSheet);
  EXPECT_DOUBLE_EQ(space.place({100, 100}, {100, 110}, "2 yellow", -1)->at.y, 100);
  const auto moved = space.place({110, 102}, {110, 112}, "4 yellow", -1);
  EXPECT_DOUBLE_EQ(moved->at.y, 102 - 16 - 16);  // one line up would still touch
  EXPECT_TRUE(moved->from) << "so far that a line leads there";
  EXPECT_DOUBLE_EQ(space.place({300, 100}, {300, 110}, "1 red", -1)->at.y, 100);
}

struct Box {
  double left, top, right, bottom;
};

Box box_of(const LabelSpace::Placed& placed, const std::string& text) {
  const double half = text_width(text) / 2;
  return {placed.at.x - half, placed.at.y - 12, placed.at.x + half, placed.at.y + 3};
}

// 32 things in a heap, with names as long as a log can have.
TEST(LabelSpace, AHeapOfLongNamesStaysApartAndOnTheSheet) {
  LabelSpace space({0, 0, 886, 560});
  std::vector<Box> boxes;
  for (int i = 0; i < 32; ++i) {
    const std::string text = std::to_string(i + 1) + " a name that is very long, " + std::to_string(i);
    const Point named{420.0 + 3 * (i % 6), 260.0 + 4 * (i / 6)};
    const auto placed = space.place({named.x, named.y - 14}, named, text, -1);
    ASSERT_TRUE(placed) << i;
    boxes.push_back(box_of(*placed, text));
  }
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Box& a = boxes[i];
    EXPECT_TRUE(a.left >= 0 && a.right <= 886 && a.top >= 0 && a.bottom <= 560) << i;
    for (std::size_t k = 0; k < i; ++k) {
      const Box& b = boxes[k];
      EXPECT_FALSE(a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom) << i << " and " << k;
    }
  }
}

TEST(LabelSpace, KeepsALabelAtTheEdgeOnTheSheet) {
  LabelSpace space(kSheet);
  const auto placed = space.place({395, 20}, {395, 30}, "1 orange box", -1);
  ASSERT_TRUE(placed);
  EXPECT_LE(placed->at.x + text_width("1 orange box") / 2, 400);
}

TEST(LabelSpace, SaysWhenThereIsNoPlace) {
  LabelSpace space(kSheet);
  EXPECT_FALSE(space.place({200, 100}, {200, 110}, std::string(100, 'x'), -1)) << "wider than the sheet";
  ASSERT_TRUE(space.place({200, 100}, {200, 110}, "here", 1));
  EXPECT_TRUE(space.place({200, 100}, {200, 110}, "near", 1, 0)) << "some lines further";
}

TEST(TextWidth, CountsLettersNotBytes) {
  EXPECT_DOUBLE_EQ(text_width("\u00e4\u00e4"), text_width("\u00f6\u00f6"));
  EXPECT_LT(text_width("\u00e4\u00e4"), text_width("aaaa"));
  EXPECT_GT(text_width("\u7bb1"), text_width("a"));
  EXPECT_GT(text_width("WWW"), text_width("iii"));
  EXPECT_GT(text_width("\xff\xfe"), 0);
}

TEST(ShortNames, CutsInTheMiddleAndNeverAlike) {
  ShortNames names(100);
  EXPECT_EQ(names.shortened("short"), "short");
  const std::string begin = "the same twenty letters and ";
  const std::string end = " the same end";
  std::vector<std::string> shown;
  for (int i = 0; i < 5; ++i) {
    shown.push_back(names.shortened(begin + std::to_string(i) + end));
    EXPECT_LE(text_width(shown.back()), 100) << shown.back();
    for (std::size_t k = 0; k + 1 < shown.size(); ++k) EXPECT_NE(shown[k], shown.back());
  }
  EXPECT_EQ(names.shortened(begin + "0" + end), shown[0]) << "the same name reads the same";
  EXPECT_EQ(names.shortened("\u7bb1\u7bb1\u7bb1\u7bb1\u7bb1\u7bb1\u7bb1\u7bb1\u7bb1\u7bb1"),
            "\u7bb1\u7bb1\u7bb1\u2026\u7bb1\u7bb1");
}

TEST(MapFrame, StandsAnEmptyRun) {
  const MapFrame f = fit_map({}, std::nullopt);
  EXPECT_TRUE(std::isfinite(f.scale));
  EXPECT_GT(f.scale, 0);
}

}  // namespace
}  // namespace fencepost::host
