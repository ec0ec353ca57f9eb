#include "host/paper/chart.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/host/report/markup_checker.hpp"

namespace fencepost::host {
namespace {

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

Chart example() {
  Chart chart{"A < B", "x", "y", 0, 10, 0, 1, {}};
  chart.series.push_back({"one & all", "#112233", {}, {{0, 0}, {5, 0.5}, {10, 1}}, true, false, 1});
  return chart;
}

TEST(DrawChart, PlacesPointsBetweenTheAxes) {
  // The plot is 430 px by 260 px: the three points lie on its diagonal.
  EXPECT_TRUE(holds(draw_chart(example()), "d=\"M0.00 260.00L215.00 130.00L430.00 0.00\"")) << draw_chart(example());
}

TEST(DrawChart, IsWellFormedWithItsNames) {
  const std::string svg = draw_chart(example());
  EXPECT_EQ(testing::find_fault(svg), "");
  EXPECT_TRUE(holds(svg, "A &lt; B"));
  EXPECT_TRUE(holds(svg, "one &amp; all"));
  EXPECT_TRUE(holds(svg_file(svg), "<?xml"));
}

TEST(DrawChart, InterruptsALineWhereAValueIsMissing) {
  Chart chart = example();
  chart.series[0].points = {{0, 0}, {5, std::nan("")}, {10, 1}};
  EXPECT_TRUE(holds(draw_chart(chart), "d=\"M0.00 260.00M430.00 0.00\""));
}

TEST(DrawChart, DrawsDotsWithoutALine) {
  Chart chart = example();
  chart.series[0].line = false;
  chart.series[0].dots = true;
  const std::string svg = draw_chart(chart);
  EXPECT_TRUE(holds(svg, R"(<circle cx="215.00" cy="130.00")"));
  EXPECT_FALSE(holds(svg, "L215.00 130.00"));
}

}  // namespace
}  // namespace fencepost::host
