// Alert records as stretches of time at one level.
#pragma once

#include <vector>

#include "host/result/result.hpp"

namespace fencepost::host {

/// One object's level from `begin` to `end`; distance at its beginning.
struct AlertSpan {
  double begin = 0;
  double end = 0;
  record::AlertLevel level = record::AlertLevel::kClear;
};

struct AlertSeries {
  std::uint32_t id = 0;
  std::uint8_t signature = 0;
  std::vector<const record::AlertReport*> records;  ///< in order; borrowed from the document
  std::vector<AlertSpan> spans;                     ///< neighbours of equal level are joined
};

/// First and last time of the run, from its path and its alerts.
struct TimeRange {
  double begin = 0;
  double end = 0;
};
TimeRange time_range(const ResultDocument& document);

/// One series per object that ever raised an alert, by id. A level holds until the object's next record, at most
/// to the end of the run.
std::vector<AlertSeries> alert_series(const ResultDocument& document);

}  // namespace fencepost::host
