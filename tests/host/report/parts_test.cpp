#include <gtest/gtest.h>

#include <cmath>
#include <limits>

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

TEST(LabelSpace, MovesALabelOffAnother) {
  LabelSpace space;
  EXPECT_DOUBLE_EQ(space.place(100, 100, "2 yellow", -1), 100);
  EXPECT_DOUBLE_EQ(space.place(110, 102, "4 yellow", -1), 102 - 16 - 16);  // one line up would still touch
  EXPECT_DOUBLE_EQ(space.place(300, 100, "1 red", -1), 100);
}

TEST(MapFrame, StandsAnEmptyRun) {
  const MapFrame f = fit_map({}, std::nullopt);
  EXPECT_TRUE(std::isfinite(f.scale));
  EXPECT_GT(f.scale, 0);
}

}  // namespace
}  // namespace fencepost::host
