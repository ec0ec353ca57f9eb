#include "host/report/map_axes.hpp"

#include <fmt/format.h>

#include "host/report/markup.hpp"
#include "host/report/ticks.hpp"

namespace fencepost::host {
namespace {

using markup::figure;
using markup::px;

constexpr double kMinGrid = 52;      ///< px between grid lines: room for a label
constexpr double kMinScaleBar = 70;  ///< px
constexpr double kAxisArrow = 46;    ///< px

std::string line(double x1, double y1, double x2, double y2, const char* style) {
  return fmt::format(R"(<line class="{}" x1="{}" y1="{}" x2="{}" y2="{}"/>)", style, px(x1), px(y1), px(x2), px(y2));
}

}  // namespace

std::string draw_grid(const MapFrame& f) {
  const double step = nice_step(kMinGrid / f.scale);
  const int decimals = step_decimals(step);
  const double bottom = f.top + f.height;
  const double right = f.left + f.width;
  std::string svg = "<g class=\"grid\">";
  for (const double x : ticks(f.x_min(), f.x_max(), step)) {
    svg += line(f.x(x), f.top, f.x(x), bottom, x == 0 ? "zero" : "rule");
    svg += fmt::format(R"(<text x="{}" y="{}" text-anchor="middle">{}</text>)", px(f.x(x)), px(bottom + 18),
                       figure(x, decimals));
  }
  for (const double y : ticks(f.y_min(), f.y_max(), step)) {
    svg += line(f.left, f.y(y), right, f.y(y), y == 0 ? "zero" : "rule");
    svg += fmt::format(R"(<text x="{}" y="{}" text-anchor="end">{}</text>)", px(f.left - 7), px(f.y(y) + 4.5),
                       figure(y, decimals));
  }
  svg += fmt::format(R"(<rect class="border" x="{}" y="{}" width="{}" height="{}"/>)", px(f.left), px(f.top),
                     px(f.width), px(f.height));
  svg += fmt::format(R"(<text class="title" x="{}" y="{}" text-anchor="middle">x in m, forward at the start</text>)",
                     px(f.left + f.width / 2), px(bottom + 38));
  svg += fmt::format(
      R"svg(<text class="title" transform="translate(13 {}) rotate(-90)" text-anchor="middle">y in m, left</text></g>)svg",
      px(f.top + f.height / 2));
  return svg + "\n";
}

std::string draw_origin(const MapFrame& f) {
  if (!f.shows({0, 0})) return {};
  const double x = f.x(0);
  const double y = f.y(0);
  const double tip_x = x + kAxisArrow;
  const double tip_y = y - kAxisArrow;
  std::string svg = "<g class=\"origin\"><title>Origin of the map frame</title>";
  svg += line(x, y, tip_x, y, "axis");
  svg += line(x, y, x, tip_y, "axis");
  svg += fmt::format(R"(<path class="tip" d="M{} {}l-9 -4v8zM{} {}l-4 9h8z"/>)", px(tip_x + 4), px(y), px(x),
                     px(tip_y - 4));
  svg += fmt::format(R"(<text x="{}" y="{}">x</text>)", px(tip_x + 8), px(y + 4));
  svg += fmt::format(R"(<text x="{}" y="{}">y</text></g>)", px(x - 4), px(tip_y - 9));
  return svg + "\n";
}

std::string draw_scale_bar(const MapFrame& f) {
  const double metres = nice_step(kMinScaleBar / f.scale);
  const double length = metres * f.scale;
  const double x = f.left + f.width - length;
  const double y = f.top + f.height + 34;  // under the plot, where it hides nothing
  return fmt::format(
             R"(<g class="scale"><path d="M{0} {1}v7h{2}v-7"/><text x="{3}" y="{4}" text-anchor="end">{5} m</text></g>)",
             px(x), px(y - 3), px(length), px(x - 8), px(y + 4), figure(metres, step_decimals(metres))) +
         "\n";
}

}  // namespace fencepost::host
