// Line and point charts as SVG that needs no stylesheet: the same element is in the page and in a file of its own.
#pragma once

#include <string>
#include <vector>

#include "host/geometry/polygon.hpp"

namespace fencepost::host {

struct ChartSeries {
  std::string name;  ///< in the legend; empty: not there
  std::string colour;
  std::string dash;  ///< stroke-dasharray; empty: solid
  std::vector<Point> points;
  bool line = true;
  bool dots = false;
  double opacity = 1;
};

struct Chart {
  std::string title;
  std::string x_title;
  std::string y_title;
  double x_min = 0;
  double x_max = 1;
  double y_min = 0;
  double y_max = 1;
  std::vector<ChartSeries> series;
};

/// Everything outside the axes is cut off. Points that are not finite are left out and interrupt their line.
std::string draw_chart(const Chart& chart);

/// The same as a file.
std::string svg_file(const std::string& svg);

}  // namespace fencepost::host
