#include "host/paper/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/report/markup.hpp"
#include "host/report/ticks.hpp"

namespace fencepost::host {
namespace {

using markup::escaped;
using markup::figure;
using markup::px;

constexpr double kWidth = 500;
constexpr double kPlotHeight = 260;
constexpr double kLeft = 56;
constexpr double kRight = 14;
constexpr double kTop = 30;
constexpr double kAxis = 46;
constexpr double kLegendLine = 20;
constexpr double kLegendEntry = 222;  // px across
constexpr double kMinTick = 44;
constexpr const char* kText =
    R"(font-family="system-ui, -apple-system, 'Segoe UI', Roboto, Arial, sans-serif" font-size="13" fill="#5a6775")";

class Drawing {
 public:
  explicit Drawing(const Chart& chart) : chart_(chart) {}

  std::string svg() {
    const double height = kTop + kPlotHeight + kAxis + kLegendLine * static_cast<double>(legend_lines());
    out_ = fmt::format(R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {} {}" role="img" aria-label="{}" {}>)",
                       px(kWidth), px(height), escaped(chart_.title), kText);
    out_ += fmt::format(R"(<text x="{}" y="18" style="font-weight:600;fill:#1c2733">{}</text>)", px(kLeft),
                        escaped(chart_.title));
    draw_axes();
    // A nested drawing cuts off what is outside.
    out_ += fmt::format(R"(<svg x="{}" y="{}" width="{}" height="{}" overflow="hidden">)", px(kLeft), px(kTop),
                        px(plot_width()), px(kPlotHeight));
    for (const ChartSeries& series : chart_.series) draw_series(series);
    out_ += "</svg>";
    draw_legend();
    return out_ + "</svg>\n";
  }

 private:
  static double plot_width() { return kWidth - kLeft - kRight; }
  [[nodiscard]] double x(double value) const {
    return (value - chart_.x_min) / (chart_.x_max - chart_.x_min) * plot_width();
  }
  [[nodiscard]] double y(double value) const {
    return kPlotHeight - (value - chart_.y_min) / (chart_.y_max - chart_.y_min) * kPlotHeight;
  }

  [[nodiscard]] std::size_t entries() const {
    return static_cast<std::size_t>(std::count_if(chart_.series.begin(), chart_.series.end(),
                                                  [](const ChartSeries& series) { return !series.name.empty(); }));
  }
  [[nodiscard]] std::size_t legend_lines() const { return (entries() + 1) / 2; }

  void draw_axes() {
    const double x_step = nice_step(kMinTick * (chart_.x_max - chart_.x_min) / plot_width());
    for (const double value : ticks(chart_.x_min, chart_.x_max, x_step)) {
      out_ += fmt::format(
          R"(<path d="M{0} {1}v{2}" stroke="#e6eaee"/><text x="{0}" y="{3}" text-anchor="middle">{4}</text>)",
          px(kLeft + x(value)), px(kTop), px(kPlotHeight), px(kTop + kPlotHeight + 17),
          figure(value, step_decimals(x_step)));
    }
    const double y_step = nice_step(kMinTick * (chart_.y_max - chart_.y_min) / kPlotHeight);
    for (const double value : ticks(chart_.y_min, chart_.y_max, y_step)) {
      out_ +=
          fmt::format(R"(<path d="M{0} {1}h{2}" stroke="#e6eaee"/><text x="{3}" y="{4}" text-anchor="end">{5}</text>)",
                      px(kLeft), px(kTop + y(value)), px(plot_width()), px(kLeft - 7), px(kTop + y(value) + 4.5),
                      figure(value, step_decimals(y_step)));
    }
    out_ += fmt::format(R"(<rect x="{}" y="{}" width="{}" height="{}" fill="none" stroke="#b4bec8"/>)", px(kLeft),
                        px(kTop), px(plot_width()), px(kPlotHeight));
    out_ += fmt::format(R"(<text x="{}" y="{}" text-anchor="middle">{}</text>)", px(kLeft + plot_width() / 2),
                        px(kTop + kPlotHeight + 36), escaped(chart_.x_title));
    out_ += fmt::format(R"svg(<text transform="translate(14 {}) rotate(-90)" text-anchor="middle">{}</text>)svg",
                        px(kTop + kPlotHeight / 2), escaped(chart_.y_title));
  }

  void draw_series(const ChartSeries& series) {
    std::string path;
    std::string dots;
    bool pen_down = false;
    for (const Point& p : series.points) {
      const bool there = std::isfinite(p.x) && std::isfinite(p.y);
      if (there) {
        path += fmt::format("{}{} {}", pen_down ? "L" : "M", px(x(p.x)), px(y(p.y)));
        dots += fmt::format(R"(<circle cx="{}" cy="{}" r="2.6"/>)", px(x(p.x)), px(y(p.y)));
      }
      pen_down = there;
    }
    if (series.line && !path.empty()) {
      out_ += fmt::format(
          R"(<path d="{}" fill="none" stroke="{}" stroke-width="2" stroke-linejoin="round" stroke-dasharray="{}" opacity="{}"/>)",
          path, series.colour, series.dash.empty() ? "none" : series.dash, px(series.opacity));
    }
    if (series.dots)
      out_ += fmt::format(R"(<g fill="{}" opacity="{}">{}</g>)", series.colour, px(series.opacity), dots);
  }

  void draw_legend() {
    std::size_t entry = 0;
    for (const ChartSeries& series : chart_.series) {
      if (series.name.empty()) continue;
      const std::size_t line = entry / 2;
      const double left = kLeft + kLegendEntry * static_cast<double>(entry % 2);
      const double top = kTop + kPlotHeight + kAxis + kLegendLine * static_cast<double>(line) + 10;
      if (series.line) {
        out_ += fmt::format(R"(<path d="M{} {}h26" stroke="{}" stroke-width="2.4" stroke-dasharray="{}"/>)", px(left),
                            px(top - 4), series.colour, series.dash.empty() ? "none" : series.dash);
      } else {
        out_ +=
            fmt::format(R"(<circle cx="{}" cy="{}" r="3.4" fill="{}"/>)", px(left + 13), px(top - 4), series.colour);
      }
      out_ += fmt::format(R"(<text x="{}" y="{}">{}</text>)", px(left + 32), px(top), escaped(series.name));
      ++entry;
    }
  }

  const Chart& chart_;
  std::string out_;
};

}  // namespace

std::string draw_chart(const Chart& chart) { return Drawing(chart).svg(); }

std::string svg_file(const std::string& svg) {
  return R"(<?xml version="1.0" encoding="UTF-8"?>)"
         "\n" +
         svg;
}

}  // namespace fencepost::host
