#include <fmt/format.h>

#include <algorithm>

#include "host/report/alert_spans.hpp"
#include "host/report/map_path.hpp"
#include "host/report/markup.hpp"
#include "host/report/tables.hpp"
#include "host/text/plural.hpp"

namespace fencepost::host {
namespace {

using markup::figure;

std::string headline_figure(const std::string& value, const std::string& what) {
  return fmt::format("<div><dt>{}</dt><dd>{}</dd></div>", what, value);
}

std::string closest(const ResultDocument& document) {
  std::optional<base::Metres> nearest;
  for (const record::AlertReport& alert : document.alerts) {
    if (alert.has_place() && (!nearest || alert.distance < *nearest)) nearest = alert.distance;
  }
  return nearest ? figure(nearest->to_double(), 2) + " m" : "\u2013";
}

const char* worst_level(const ResultDocument& document) {
  auto worst = record::AlertLevel::kClear;
  for (const record::AlertReport& alert : document.alerts) worst = std::max(worst, alert.level);
  return record::name(worst).data();
}

}  // namespace

std::string headline_figures(const ResultDocument& document) {
  const auto confirmed = std::count_if(document.objects.begin(), document.objects.end(), [](const ObjectResult& o) {
    return o.state != record::ObjectState::kTentative;  // lost ones are confirmed, only out of sight
  });
  const LogCounts& log = document.log;
  const RefusedFrames& r = log.refused;
  std::uint64_t rejected = 0;
  for (const RejectedLines& lines : log.rejected) rejected += lines.count;
  const TimeRange range = time_range(document);

  std::string html = "<dl class=\"figures\">";
  html += headline_figure(fmt::format("{}<small> of {}</small>", confirmed, plural(document.objects.size(), "object")),
                          "confirmed");
  html += headline_figure(worst_level(document), "highest alert");
  html += headline_figure(closest(document), "closest alert");
  html += headline_figure(figure(range.end - range.begin, 1) + " s", "duration");
  html += headline_figure(figure(path_length(document.path), 2) + " m", "driven");
  html += headline_figure(fmt::format("{}", log.frames), "camera frames");
  html += headline_figure(fmt::format("{}", r.no_pose + r.odometry_gap + r.no_camera + r.queue), "frames refused");
  html += headline_figure(fmt::format("{}", rejected), "lines rejected");
  return html + "</dl>\n";
}

}  // namespace fencepost::host
