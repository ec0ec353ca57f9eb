#include "host/report/alert_spans.hpp"

#include <algorithm>
#include <map>

namespace fencepost::host {

TimeRange time_range(const ResultDocument& document) {
  std::vector<double> times;
  if (!document.path.empty()) times = {document.path.front().t, document.path.back().t};
  for (const record::AlertReport& alert : document.alerts) times.push_back(alert.t.to_double());
  if (times.empty()) return {};
  const auto [low, high] = std::minmax_element(times.begin(), times.end());
  return {*low, *high};
}

std::vector<AlertSeries> alert_series(const ResultDocument& document) {
  std::map<std::uint32_t, AlertSeries> by_id;
  for (const record::AlertReport& alert : document.alerts) {
    AlertSeries& series = by_id[alert.id];
    series.id = alert.id;
    series.signature = alert.signature;
    series.records.push_back(&alert);
  }
  const double end = time_range(document).end;
  std::vector<AlertSeries> all;
  for (auto& [id, series] : by_id) {
    for (std::size_t i = 0; i < series.records.size(); ++i) {
      const double from = series.records[i]->t.to_double();
      const double to = i + 1 < series.records.size() ? series.records[i + 1]->t.to_double() : end;
      const record::AlertLevel level = series.records[i]->level;
      if (!series.spans.empty() && series.spans.back().level == level) {
        series.spans.back().end = to;
      } else {
        series.spans.push_back({from, to, level});
      }
    }
    all.push_back(std::move(series));
  }
  return all;
}

}  // namespace fencepost::host
