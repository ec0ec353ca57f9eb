#include "host/report/report.hpp"

#include <gtest/gtest.h>

#include "tests/host/report/markup_checker.hpp"
#include "tests/host/report/scenes.hpp"
#include "tests/text.hpp"

namespace fencepost::host {
namespace {

using test::count;
using test::holds;
using testing::arc_document;
using ::testing::AssertionFailure;
using ::testing::AssertionResult;
using ::testing::AssertionSuccess;
using testing::find_fault;
using testing::two_object_scene;

std::string arc_report() { return write_report(arc_document(), two_object_scene(), {"run.log", "fencepost 0"}); }

// The checker itself must be able to fail.
TEST(FindFault, FindsFaults) {
  EXPECT_EQ(find_fault("<a><b x=\"1\"/>t &amp; u</a>"), "");
  for (const char* bad : {"<a>", "<a></b>", "<a>&</a>", "<a x=\"<\"/>", "a > b", "<a x=\"1\"y\"/>", "</a>"}) {
    EXPECT_NE(find_fault(bad), "") << bad;
  }
}

TEST(Report, IsWellFormed) { EXPECT_EQ(find_fault(arc_report()), ""); }

TEST(Report, AnEmptyRunIsWellFormedToo) {
  const std::string page = write_report({}, std::nullopt, {});
  EXPECT_EQ(find_fault(page), "");
  EXPECT_TRUE(holds(page, "No objects."));
  EXPECT_TRUE(holds(page, "No alerts in this run."));
}

TEST(Report, GivesTheSameBytesTwice) { EXPECT_EQ(arc_report(), arc_report()); }

TEST(Report, NeedsNothingFromElsewhere) {
  const std::string page = arc_report();
  for (const char* foreign :
       {"http:", "https:", "src=", "@import", "<link", "<script", "javascript:", "onload=", "onclick="})
    EXPECT_FALSE(holds(page, foreign)) << foreign;
  EXPECT_TRUE(holds(page, "content=\"default-src 'none'; style-src 'unsafe-inline'\""));
}

TEST(Report, NamesAreWholeInItsTables) {
  ResultDocument d = arc_document();
  d.signatures[0].name = "alike in their first twenty: one";
  d.signatures[1].name = "alike in their first twenty: two";
  Scene truth = two_object_scene();
  const std::string longest(300, 'x');
  truth.objects[0].name = longest + "1";
  truth.objects[1].name = longest + "2";
  const std::string page = write_report(d, truth, {});
  for (const char* name : {">alike in their first twenty: one</td>", ">1 alike in their first twenty: one</text>",
                           ">alike in their first twenty: two</td>", ">2 alike in their first twenty: two</text>"}) {
    EXPECT_TRUE(holds(page, name));
  }
  EXPECT_TRUE(holds(page, "<td class=\"name\">" + longest + "1</td>"));
  EXPECT_TRUE(holds(page, "<td class=\"name\">" + longest + "2</td>"));
  EXPECT_TRUE(holds(page, "xxx1</text>"));
  EXPECT_FALSE(holds(page, longest + "1</text>"));
}

TEST(Report, ShowsEveryObjectTruthAndModel) {
  const std::string page = arc_report();
  for (const char* part : {">1 red</text>", ">2 blue</text>", ">red box</text>", ">blue post</text>",
                           "hidden &lt;cone&gt;, true footprint", "sig 7", "seen from one place only"}) {
    EXPECT_TRUE(holds(page, part));
  }
  for (const char* model : {"cylinder", "cylinder_paper", "carve", "clip"}) {
    const std::string layer = std::string(model) == "cylinder_paper" ? "cylinder-paper" : model;
    EXPECT_TRUE(holds(page, "<g class=\"layer-" + layer + "\""));
    EXPECT_TRUE(holds(page, "id=\"show-" + layer + "\""));
    EXPECT_TRUE(holds(page, "#show-" + layer + ":not(:checked)~.figure .layer-" + layer));
    EXPECT_TRUE(holds(page, std::string("<title>object 1 red, ") + model + ", confirmed</title>"));
  }
}

TEST(Report, ShowsEveryAlertInTheTableAndTheTimeline) {
  const std::string page = arc_report();
  const std::size_t alerts = arc_document().alerts.size();
  EXPECT_EQ(count(page, "<td><span class=\"level "), alerts);
  EXPECT_EQ(count(page, "r=\"3.2\""), alerts);
  EXPECT_TRUE(holds(page, "<details><summary>25 alert records"));  // long: folded
}

TEST(Report, TellsDigestProfileAndWhatWasLeftOut) {
  const std::string page = arc_report();
  for (const char* part : {"5f3a99c0de77e1a1", "<code>full</code>", "lines rejected: crc", "first in line 12",
                           "frames refused: no_pose"}) {
    EXPECT_TRUE(holds(page, part));
  }
}

TEST(Report, ComparesOnlyWhereTheTruthIsKnown) {
  EXPECT_TRUE(holds(arc_report(), "Against the truth"));
  EXPECT_TRUE(holds(arc_report(), "True objects that were not found: hidden &lt;cone&gt;."));
  EXPECT_FALSE(holds(write_report(arc_document(), std::nullopt, {}), "Against the truth"));
}

TEST(Report, TextFromLogsAndScenesIsEscaped) {
  ResultDocument d = arc_document();
  d.signatures[0].name = "<script>alert(1)</script>";
  d.objects[0].models[0].reason = "\"'&";
  d.profile = "<b>";
  d.objects[1].models[2].name = "x\"><script>";
  Scene truth = two_object_scene();
  truth.objects[0].name = "</svg><script>alert(2)</script>\x01\xff";
  const std::string page = write_report(d, truth, {"<img onerror=x>", "<i>"});
  EXPECT_EQ(find_fault(page), "");
  EXPECT_EQ(count(page, "<script"), 0U);
  EXPECT_FALSE(holds(page, "<img"));
  EXPECT_FALSE(holds(page, "\x01"));
  EXPECT_FALSE(holds(page, "\xff"));
}

TEST(Report, OpenSidesAreDrawnBroken) {
  ResultDocument d = arc_document();
  EXPECT_FALSE(holds(write_report(d, std::nullopt, {}), "<path class=\"open\""));
  d.objects[0].models[3].open = {{{1, 0}, {1.1, 0}}};
  const std::string page = write_report(d, std::nullopt, {});
  EXPECT_EQ(find_fault(page), "");
  EXPECT_TRUE(holds(page, "<path class=\"open\""));
  EXPECT_TRUE(holds(page, "<title>object 1: no edge was seen here, it may go on</title>"));
}

TEST(Report, AModelWithoutAStyleOfItsOwnIsDrawn) {
  ResultDocument d = arc_document();
  d.objects[0].models[3].name = "brand_new";
  EXPECT_TRUE(holds(write_report(d, std::nullopt, {}), "<g class=\"layer-brand-new\""));
}

}  // namespace
}  // namespace fencepost::host
