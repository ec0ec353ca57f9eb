#include "host/report/timeline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <numbers>

#include "host/report/alert_spans.hpp"
#include "host/report/markup.hpp"
#include "host/report/palette.hpp"
#include "host/report/ticks.hpp"
#include "host/result/lookup.hpp"
#include "host/text/plural.hpp"

namespace fencepost::host {
namespace {

using markup::escaped;
using markup::figure;
using markup::px;

constexpr double kWidth = 960;  // the whole drawing, px
constexpr double kLeft = 64;    // room for distances
constexpr double kRight = 16;
constexpr double kName = 18;  // a line of its own: any name has room
constexpr double kRow = 116;
constexpr double kStrip = 18;
constexpr double kCurve = 48;
constexpr double kAxis = 44;
constexpr double kMinTick = 70;
constexpr std::size_t kUnfolded = 12;  ///< alerts shown without a click

struct TimeAxis {
  TimeRange range;
  [[nodiscard]] double x(double t) const {
    const double length = std::max(range.end - range.begin, 1e-3);
    return kLeft + (t - range.begin) / length * (kWidth - kLeft - kRight);
  }
};

std::string draw_strip(const TimeAxis& axis, const AlertSeries& series, double top) {
  std::string svg;
  for (const AlertSpan& span : series.spans) {
    const double x = axis.x(span.begin);
    const double width = std::max(axis.x(span.end) - x, 2.5);  // an alert of an instant is still seen
    const auto rank = static_cast<double>(span.level);
    const double height = span.level == record::AlertLevel::kClear ? 3 : kStrip * std::min(rank / 3, 1.0);
    svg += fmt::format(
        R"(<rect x="{}" y="{}" width="{}" height="{}" fill="{}"><title>{} from {} s to {} s</title></rect>)", px(x),
        px(top + kStrip - height), px(width), px(height), level_colour(span.level), record::name(span.level),
        figure(span.begin, 2), figure(span.end, 2));
  }
  return svg;
}

std::string draw_distances(const TimeAxis& axis, const AlertSeries& series, double top) {
  std::vector<const record::AlertReport*> placed;
  std::copy_if(series.records.begin(), series.records.end(), std::back_inserter(placed),
               [](const auto* alert) { return alert->has_place(); });
  if (placed.empty()) return {};
  const auto nearest = *std::min_element(placed.begin(), placed.end(),
                                         [](const auto* a, const auto* b) { return a->distance < b->distance; });
  double most = 0;
  for (const auto* alert : placed) most = std::max(most, alert->distance.to_double());
  const double full = nice_step(std::max(most, 0.1));
  const auto y = [&](double distance) { return top + kCurve - distance / full * kCurve; };
  std::string svg = fmt::format(R"(<path class="rule" d="M{0} {1}H{2}M{0} {3}H{2}"/>)", px(kLeft), px(y(0)),
                                px(kWidth - kRight), px(y(full)));
  svg += fmt::format(
      R"(<text x="{0}" y="{1}" text-anchor="end">{2} m</text><text x="{0}" y="{3}" text-anchor="end">0</text>)",
      px(kLeft - 8), px(y(full) + 8), figure(full, step_decimals(full)), px(y(0) + 4));
  std::string points;
  std::string dots;
  for (const auto* alert : placed) {
    const double x = axis.x(alert->t.to_double());
    const double at = y(alert->distance.to_double());
    points += fmt::format("{}{},{}", points.empty() ? "" : " ", px(x), px(at));
    dots += fmt::format(R"(<circle cx="{}" cy="{}" r="3.2" fill="{}"><title>{} s: {}, {} m</title></circle>)", px(x),
                        px(at), level_colour(alert->level), figure(alert->t.to_double(), 2), record::name(alert->level),
                        figure(alert->distance.to_double(), 2));
  }
  const double nearest_x = axis.x(nearest->t.to_double());
  // Below its point the label is clear of the curve: nothing is nearer.
  const char* anchor = nearest_x > kWidth - kRight - kMinTick / 2 ? "end" : "middle";
  return svg + fmt::format(R"(<polyline class="curve" points="{}"/><g class="dots">{}</g>)", points, dots) +
         fmt::format(R"(<text class="nearest" x="{}" y="{}" text-anchor="{}">{} m</text>)", px(nearest_x),
                     px(y(nearest->distance.to_double()) + 18), anchor, figure(nearest->distance.to_double(), 2));
}

std::string whose(std::uint32_t id) { return id == record::kNoObject ? "guard:" : std::to_string(id); }

std::string draw_row(const ResultDocument& document, const TimeAxis& axis, const AlertSeries& series, double top) {
  const std::string colour = ink(signature_colour(document, series.signature), kTextLuminance);
  std::string svg =
      fmt::format(R"(<g><text class="name" x="{}" y="{}" style="fill:{}">{} {}</text>)", px(kLeft), px(top + 13),
                  colour, whose(series.id), escaped(signature_name(document, series.signature)));
  svg += draw_strip(axis, series, top + kName) + draw_distances(axis, series, top + kName + kStrip + 10);
  return svg + "</g>\n";
}

std::string draw_time_axis(const TimeAxis& axis, double top, double bottom) {
  const double length = std::max(axis.range.end - axis.range.begin, 1e-3);
  const double step = nice_step(kMinTick * length / (kWidth - kLeft - kRight));
  std::string svg = "<g class=\"grid\">";
  for (const double t : ticks(axis.range.begin, axis.range.end, step)) {
    svg += fmt::format(R"(<path class="rule" d="M{0} {1}V{2}"/><text x="{0}" y="{3}" text-anchor="middle">{4}</text>)",
                       px(axis.x(t)), px(top), px(bottom), px(bottom + 17), figure(t, step_decimals(step)));
  }
  svg += fmt::format(R"(<text class="title" x="{}" y="{}" text-anchor="middle">time in s</text></g>)",
                     px((kLeft + kWidth - kRight) / 2), px(bottom + 36));
  return svg + "\n";
}

std::string level_legend() {
  std::string html = "<p class=\"levels\">";
  for (const record::AlertLevel level : {record::AlertLevel::kNotice, record::AlertLevel::kWarn,
                                         record::AlertLevel::kStop, record::AlertLevel::kBlind}) {
    html += fmt::format(R"(<span><i style="background:{}"></i>{}</span>)", level_colour(level), record::name(level));
  }
  return html + "<span><b class=\"line\"></b>distance from the robot's origin to the nearest point, m</span></p>";
}

std::string alert_row(const ResultDocument& document, const record::AlertReport& alert) {
  const double degrees = alert.bearing.to_double() * 180 / std::numbers::pi;
  return fmt::format(
      "<tr><td class=\"n\">{}</td><td><span class=\"level {}\">{}</span></td><td>{} {}</td><td class=\"n\">{}</td>"
      "<td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td></tr>\n",
      figure(alert.t.to_double(), 2), record::name(alert.level), record::name(alert.level), whose(alert.id),
      escaped(signature_name(document, alert.signature)), figure(alert.distance.to_double(), 2), figure(degrees, 0),
      alert.ttc ? figure(alert.ttc->to_double(), 1) : "\u2013", figure(alert.confidence.to_double(), 2));
}

}  // namespace

std::string alert_timeline(const ResultDocument& document) {
  const std::vector<AlertSeries> all = alert_series(document);
  if (all.empty()) return "<p>No alerts in this run.</p>\n";
  const TimeAxis axis{time_range(document)};
  const double bottom = 8 + kRow * static_cast<double>(all.size());
  std::string html = level_legend();
  html += fmt::format(R"(<div class="figure"><svg viewBox="0 0 {} {}" role="img" aria-label="Alerts over time">)",
                      px(kWidth), px(bottom + kAxis));
  html += draw_time_axis(axis, 4, bottom);
  for (std::size_t i = 0; i < all.size(); ++i) {
    html += draw_row(document, axis, all[i], 8 + kRow * static_cast<double>(i));
  }
  return html + "</svg></div>\n";
}

std::string alert_table(const ResultDocument& document) {
  if (document.alerts.empty()) return {};
  std::string html = fmt::format("<details{}><summary>{}</summary><div class=\"scroll\"><table><thead><tr>",
                                 document.alerts.size() <= kUnfolded ? " open=\"open\"" : "",
                                 plural(document.alerts.size(), "alert record"));
  html +=
      "<th class=\"n\">time, s</th><th>level</th><th>object</th><th class=\"n\">distance, m</th>"
      "<th class=\"n\">bearing, \u00b0 (left +)</th><th class=\"n\">contact in, s</th>"
      "<th class=\"n\">confidence</th></tr></thead><tbody>\n";
  for (const record::AlertReport& alert : document.alerts) html += alert_row(document, alert);
  return html + "</tbody></table></div></details>\n";
}

}  // namespace fencepost::host
