#include "host/calibrate/calibration_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/report/markup.hpp"
#include "host/report/palette.hpp"
#include "host/report/ticks.hpp"

namespace fencepost::host {
namespace {

using markup::px;

constexpr double kSide = 420;  // px, of a map
constexpr double kGap = 50;    // px, between and around
constexpr double kPlot = 180;  // px, height of a residual plot
constexpr double kWide = 2 * kSide + 3 * kGap;
constexpr double kHigh = kSide + kPlot + 3.4 * kGap;

/// Map metres to pixels of one panel, x to the right, y up.
struct Frame {
  double left;
  double top;
  double scale;
  Point low;
  [[nodiscard]] std::string at(Point p) const {
    return px(left + (p.x - low.x) * scale) + "," + px(top + kSide - (p.y - low.y) * scale);
  }
};

struct Extent {
  Point low{1e9, 1e9};
  Point high{-1e9, -1e9};
  void add(Point p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
};

/// The extent of both maps: objects and ways, without the feet, since some lie far off.
Extent extent_of(const Calibration& calibration) {
  Extent extent;
  for (const CalibratedObject& object : calibration.objects) {
    for (const Point p : object.outline) extent.add(p);
  }
  for (const Point p : calibration.way_before) extent.add(p);
  for (const Point p : calibration.way_after) extent.add(p);
  constexpr double kMargin = 0.15;  // m
  extent.low = {extent.low.x - kMargin, extent.low.y - kMargin};
  extent.high = {extent.high.x + kMargin, extent.high.y + kMargin};
  return extent;
}

std::string text_at(double x, double y, std::string_view text, const char* anchor = "start") {
  return fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"{}\">{}</text>\n", px(x), px(y), anchor,
                     markup::escaped(text));
}

std::string polyline(const Frame& frame, const std::vector<Point>& points, const char* attributes) {
  std::string out = "<polyline fill=\"none\" " + std::string(attributes) + " points=\"";
  for (const Point p : points) out += frame.at(p) + " ";
  return out + "\"/>\n";
}

/// Small squares, one path: a thousand elements would make the file ten times as large.
std::string dots(const Frame& frame, const std::vector<Point>& points, const Extent& extent,
                 const std::string& colour) {
  std::string out = fmt::format("<path fill=\"{}\" fill-opacity=\"0.5\" d=\"", colour);
  for (const Point p : points) {
    if (p.x < extent.low.x || p.y < extent.low.y || p.x > extent.high.x || p.y > extent.high.y) continue;
    out += "M" + frame.at(p) + "h2v2h-2z";
  }
  return out + "\"/>\n";
}

std::string map_panel(const Calibration& calibration, const Extent& extent, bool after) {
  const double span = std::max(extent.high.x - extent.low.x, extent.high.y - extent.low.y);
  const Frame frame{after ? 2 * kGap + kSide : kGap, kGap, kSide / span, extent.low};
  std::string out =
      text_at(frame.left, kGap - 12, after ? "after: feet on the floor, as found" : "before: as configured");
  out += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#888\"/>\n",
                     px(frame.left), px(kGap), px(kSide), px(kSide));
  out += polyline(frame, after ? calibration.way_after : calibration.way_before,
                  "stroke=\"#555\" stroke-dasharray=\"4 3\"");
  for (const CalibratedObject& object : calibration.objects) {
    const std::string colour = ink(object.rgb, kLineLuminance);
    out += dots(frame, after ? object.feet_after : object.feet_before, extent, colour);
    if (!after) continue;
    std::vector<Point> outline(object.outline.begin(), object.outline.end());
    outline.push_back(outline.front());
    out += polyline(frame, outline, ("stroke-width=\"1.5\" stroke=\"" + colour + "\"").c_str());
  }
  const double metre = nice_step(span / 6);
  out += fmt::format("<path stroke=\"#333\" stroke-width=\"2\" d=\"M{},{}h{}\"/>\n", px(frame.left + 8),
                     px(kGap + kSide - 8), px(metre * frame.scale));
  return out + text_at(frame.left + 8, kGap + kSide - 14, fmt::format("{} m", metre));
}

std::string residual_panel(const Calibration& calibration, bool after) {
  const Residuals& residuals = after ? calibration.after : calibration.before;
  const double left = after ? 2 * kGap + kSide : kGap;
  const double middle = 2 * kGap + kSide + kPlot / 2;
  // One scale for both: that is the comparison.
  const double most = std::max(3 * calibration.before.columns_px, 1.0);
  const double width = calibration.configured.width;
  std::string out = fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#888\"/>\n",
                                px(left), px(middle - kPlot / 2), px(kSide), px(kPlot));
  out += fmt::format("<path stroke=\"#888\" d=\"M{},{}h{}\"/>\n", px(left), px(middle), px(kSide));
  out += fmt::format("<path fill=\"{}\" fill-opacity=\"0.5\" d=\"", after ? "#1f5fa8" : "#b04a00");
  for (const EdgeResidual& edge : residuals.edges) {
    const double share = edge.residual / most;
    if (std::abs(share) > 1) continue;
    out += "M" + px(left + kSide * edge.column / width) + "," + px(middle - share * kPlot / 2) + "h2v2h-2z";
  }
  out += "\"/>\n";
  out += text_at(left, middle - kPlot / 2 - 8,
                 fmt::format("edges missed: {:.2f} px, {:.2f} cm (68 %)", residuals.columns_px, residuals.columns_cm));
  out += text_at(left - 4, middle - kPlot / 2 + 12, fmt::format("{:.0f} px", most), "end");
  out += text_at(left - 4, middle + kPlot / 2, fmt::format("-{:.0f}", most), "end");
  out += text_at(left, middle + kPlot / 2 + 16, "column 0");
  return out + text_at(left + kSide, middle + kPlot / 2 + 16, fmt::format("{:.0f}", width - 1), "end");
}

}  // namespace

std::string calibration_picture(const Calibration& calibration) {
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" font-family=\"sans-serif\" font-size=\"13\">\n"
      "<title>Calibration: before and after</title>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
      px(kWide), px(kHigh));
  const Extent extent = extent_of(calibration);
  for (const bool after : {false, true})
    out += map_panel(calibration, extent, after) + residual_panel(calibration, after);
  return out + "</svg>\n";
}

}  // namespace fencepost::host
