#include "host/paper/plan.hpp"

#include <fmt/format.h>

#include <cmath>

#include "host/report/markup.hpp"
#include "host/report/ticks.hpp"

namespace fencepost::host {
namespace {

using markup::escaped;
using markup::px;

constexpr double kSize = 300;  // px, of the square
constexpr double kPlanTop = 26;
constexpr double kBottom = 22;
constexpr double kMinScaleBar = 50;

struct Frame {
  const Plan& plan;
  [[nodiscard]] double scale() const { return kSize / plan.side; }
  [[nodiscard]] std::string at(Point p) const {
    return px((p.x - plan.centre.x) * scale() + kSize / 2) + " " + px(kSize / 2 - (p.y - plan.centre.y) * scale());
  }
};

std::string path_of(const Frame& frame, const MultiPolygon& areas) {
  std::string path;
  const auto add = [&](const LinearRing& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) path += (i == 0 ? "M" : "L") + frame.at(ring[i]);
    if (!ring.empty()) path += "Z";
  };
  for (const Polygon& polygon : areas) {
    add(polygon.outer);
    for (const LinearRing& hole : polygon.holes) add(hole);
  }
  return path;
}

std::string draw_area(const Frame& frame, const PlanArea& area) {
  if (area.geometry.empty()) return {};
  return fmt::format(
      R"(<path d="{}" fill="{}" fill-opacity="{}" fill-rule="evenodd" stroke="{}" stroke-width="{}" stroke-dasharray="{}" stroke-linejoin="round"/>)",
      path_of(frame, area.geometry), area.fill, px(area.fill_opacity), area.stroke, px(area.width),
      area.dash.empty() ? "none" : area.dash);
}

std::string draw_part(const Frame& frame, const PlanPart& part) {
  std::string path;
  for (std::size_t edge = 0; edge < part.part.stretches().size(); ++edge) {
    const Point a = part.outline[edge];
    const Point b = part.outline[(edge + 1) % part.outline.size()];
    for (const Stretch01& stretch : part.part.stretches()[edge]) {
      const auto along = [&](double t) { return frame.at({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)}); };
      path += "M" + along(stretch.begin) + "L" + along(stretch.end);
    }
  }
  if (path.empty()) return {};
  return fmt::format(R"(<path d="{}" fill="none" stroke="{}" stroke-width="{}"/>)", path, part.colour, px(part.width));
}

/// An arrow head that points where the lens looks.
std::string draw_lens(const Frame& frame, const PlanLens& lens) {
  const auto corner = [&](double ahead, double left) {
    const double k = 1 / frame.scale();
    const double c = std::cos(lens.heading);
    const double s = std::sin(lens.heading);
    return frame.at({lens.at.x + k * (c * ahead - s * left), lens.at.y + k * (s * ahead + c * left)});
  };
  return fmt::format(R"(<path d="M{}L{}L{}Z" fill="{}"/>)", corner(8, 0), corner(-4, 4.5), corner(-4, -4.5),
                     lens.colour);
}

std::string draw_scale_bar(const Frame& frame) {
  const double metres = nice_step(kMinScaleBar / frame.scale());
  return fmt::format(R"(<path d="M{0} {1}v6h{2}v-6" fill="none" stroke="#1c2733" stroke-width="1.4"/>)"
                     R"(<text x="{3}" y="{4}" text-anchor="end">{5} cm</text>)",
                     px(kSize - metres * frame.scale() - 2), px(kPlanTop + kSize + 5), px(metres * frame.scale()),
                     px(kSize - metres * frame.scale() - 8), px(kPlanTop + kSize + 14),
                     markup::figure(100 * metres, 0));
}

}  // namespace

std::string draw_plan(const Plan& plan) {
  const Frame frame{plan};
  std::string svg = fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {} {}" role="img" aria-label="{}" font-family="system-ui, -apple-system, 'Segoe UI', Roboto, Arial, sans-serif" font-size="13" fill="#5a6775">)",
      px(kSize), px(kPlanTop + kSize + kBottom), escaped(plan.title));
  svg += fmt::format(R"(<text x="2" y="17" style="font-weight:600;fill:#1c2733">{}</text>)", escaped(plan.title));
  svg += fmt::format(R"(<svg y="{}" width="{}" height="{}" overflow="hidden">)", px(kPlanTop), px(kSize), px(kSize));
  svg += fmt::format(R"(<rect width="{0}" height="{0}" fill="#fafbfc" stroke="#b4bec8"/>)", px(kSize));
  for (const PlanArea& area : plan.areas) svg += draw_area(frame, area);
  for (const PlanPart& part : plan.parts) svg += draw_part(frame, part);
  for (const PlanLens& lens : plan.lenses) svg += draw_lens(frame, lens);
  return svg + "</svg>" + draw_scale_bar(frame) + "</svg>\n";
}

}  // namespace fencepost::host
