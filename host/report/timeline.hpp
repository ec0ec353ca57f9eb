// Distance of each object over time, with the robot's alerts.
#pragma once

#include <string>

#include "host/result/result.hpp"

namespace fencepost::host {

/// One row per object on a common time axis: a strip of levels over the curve of distances.
std::string alert_timeline(const ResultDocument& document);

/// Every alert record, folded away when there are many.
std::string alert_table(const ResultDocument& document);

}  // namespace fencepost::host
