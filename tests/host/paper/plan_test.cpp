#include "host/paper/plan.hpp"

#include <gtest/gtest.h>

#include "tests/host/report/markup_checker.hpp"

namespace fencepost::host {
namespace {

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(DrawPlan, PlacesMetresInASquareOf300Pixels) {
  // 1 m is 300 px; the middle is (1, 2), y goes up.
  Plan plan{"a & b", {1, 2}, 1, {}, {}, {}};
  plan.areas.push_back({{{{{1, 2}, {1.5, 2}, {1.5, 2.5}}, {}}}, "#123456", "none", {}, 1, 1});
  const std::string svg = draw_plan(plan);
  EXPECT_EQ(testing::find_fault(svg), "");
  EXPECT_TRUE(holds(svg, "d=\"M150.00 150.00L300.00 150.00L300.00 0.00Z\" fill=\"#123456\"")) << svg;
  EXPECT_TRUE(holds(svg, "a &amp; b"));
  EXPECT_TRUE(holds(svg, "20 cm"));  // the scale bar
}

TEST(DrawPlan, DrawsPartsOfAPerimeter) {
  const LinearRing outline{{0.5, 1.5}, {1.5, 1.5}, {1.5, 2.5}, {0.5, 2.5}};
  PerimeterPart part(outline);
  part.add(0, {0.25, 0.75});
  part.add(1, {0, 0.5});
  Plan plan{"p", {1, 2}, 1, {}, {}, {}};
  plan.parts.push_back({part, outline, "#abcdef", 5});
  EXPECT_TRUE(holds(draw_plan(plan), "d=\"M75.00 300.00L225.00 300.00M300.00 300.00L300.00 150.00\""))
      << draw_plan(plan);
}

TEST(DrawPlan, LeavesOutWhatIsNotThere) {
  Plan plan{"p", {1, 2}, 1, {}, {}, {}};
  plan.areas.push_back({{}, "#123456", "none", {}, 1, 1});
  plan.parts.push_back({PerimeterPart({{0, 0}, {1, 0}, {1, 1}}), {{0, 0}, {1, 0}, {1, 1}}, "#abcdef", 5});
  EXPECT_FALSE(holds(draw_plan(plan), "#123456"));
  EXPECT_FALSE(holds(draw_plan(plan), "#abcdef"));
}

}  // namespace
}  // namespace fencepost::host
