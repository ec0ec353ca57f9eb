#include "host/report/tables.hpp"

#include <fmt/format.h>

#include <numbers>

#include "host/geometry/planar.hpp"
#include "host/report/markup.hpp"
#include "host/report/palette.hpp"
#include "host/result/lookup.hpp"

namespace fencepost::host {
namespace {

using markup::escaped;
using markup::figure;

constexpr double kSquareCentimetres = 1e4;  ///< per m^2
constexpr const char* kNone = "\u2013";

std::string cell(const std::string& text) { return "<td class=\"n\">" + text + "</td>"; }

/// The middle of the arc as seen from the object, counter-clockwise from x, and half its width.
std::string next_view(const NextViewResult& next) {
  constexpr double kDegrees = 180 / std::numbers::pi;
  return fmt::format("{:.0f} \u00b1 {:.0f}", next.bearing * kDegrees, next.width * kDegrees / 2);
}

std::string object_row(const ResultDocument& document, const ObjectResult& object,
                       const std::vector<std::string>& models) {
  const Circle* circle = object_circle(object);
  std::string html = fmt::format(
      "<tr><td class=\"n\">{}</td><td class=\"name\"><i class=\"swatch\" "
      "style=\"background:{}\"></i>{}</td><td>{}</td>",
      object.id, hex(signature_colour(document, object.signature)), escaped(signature_name(document, object.signature)),
      record::name(object.state));
  html += cell(fmt::format("{}", object.views));
  html += cell(circle != nullptr ? figure(circle->center.x, 3) : kNone);
  html += cell(circle != nullptr ? figure(circle->center.y, 3) : kNone);
  html += cell(circle != nullptr ? figure(circle->radius, 3) : kNone);
  html += cell(figure(object.z_max - object.z_min, 3)) + cell(figure(object.confidence, 2));
  html += cell(object.next ? next_view(*object.next) : kNone);
  for (const std::string& name : models) {
    const ModelResult* model = find_model(object, name);
    const bool silent = model == nullptr || model->geometry.empty();
    html += cell(silent ? kNone : figure(area(model->geometry) * kSquareCentimetres, 1));
  }
  return html + "</tr>\n";
}

std::string silent_models(const ResultDocument& document) {
  std::string items;
  for (const ObjectResult& object : document.objects) {
    for (const ModelResult& model : object.models) {
      if (!model.geometry.empty() || model.reason.empty()) continue;
      items += fmt::format("<li>object {}, {}: {}</li>", object.id, escaped(model.name), escaped(model.reason));
    }
  }
  if (items.empty()) return {};
  return "<details><summary>Why some models have no area</summary><ul>" + items + "</ul></details>\n";
}

std::string count_row(const char* what, std::uint64_t count, const std::string& remark = {}) {
  return fmt::format("<tr><td>{}</td><td class=\"n\">{}</td><td>{}</td></tr>\n", what, count, remark);
}

}  // namespace

std::string object_rows(const ResultDocument& document) {
  if (document.objects.empty()) return "<p>No objects.</p>\n";
  const std::vector<std::string> models = model_names(document);
  std::string html =
      "<div class=\"scroll\"><table><thead><tr><th class=\"n\">id</th><th>name</th><th>state</th>"
      "<th class=\"n\">views</th><th class=\"n\">x<small>m</small></th><th class=\"n\">y<small>m</small></th>"
      "<th class=\"n\">radius<small>m</small></th><th class=\"n\">height<small>m</small></th><th "
      "class=\"n\">confidence</th><th class=\"n\">look next from<small>deg</small></th>";
  for (const std::string& name : models)
    html += fmt::format("<th class=\"n\">{}<small>cm\u00b2</small></th>", escaped(name));
  html += "</tr></thead><tbody>\n";
  for (const ObjectResult& object : document.objects) html += object_row(document, object, models);
  return html + "</tbody></table></div>\n" + silent_models(document);
}

std::string record_counts(const ResultDocument& document) {
  const LogCounts& log = document.log;
  std::string html = "<div class=\"scroll\"><table class=\"counts\"><tbody>\n";
  html += count_row("records read", log.records) + count_row("camera frames", log.frames);
  html += count_row("odometry samples", log.odometry) + count_row("foreign lines, ignored", log.foreign);
  const RefusedFrames& refused = log.refused;
  if (refused.no_pose > 0) html += count_row("frames refused: no_pose", refused.no_pose, "no odometry in time");
  if (refused.odometry_gap > 0) {
    html += count_row("frames refused: odometry_gap", refused.odometry_gap, "odometry paused for over 0.5 s");
  }
  if (refused.no_camera > 0) html += count_row("frames refused: no_camera", refused.no_camera, "no FPCAM before them");
  if (refused.queue > 0) html += count_row("frames refused: queue", refused.queue, "the log could not keep up");
  for (std::size_t i = 0; i < log.rejected.size(); ++i) {
    if (log.rejected[i].count == 0) continue;
    const std::string what = fmt::format("lines rejected: {}", record::name(static_cast<record::Reject>(i)));
    html += count_row(what.c_str(), log.rejected[i].count, fmt::format("first in line {}", log.rejected[i].first_line));
  }
  html += "</tbody></table></div>\n";
  return html + fmt::format("<p>Profile <code>{}</code>, state digest <code>{}</code>.</p>\n",
                            escaped(document.profile), digest_text(document.digest));
}

}  // namespace fencepost::host
