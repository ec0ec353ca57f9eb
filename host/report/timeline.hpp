// When each object was how near, and what the robot said about it.
#pragma once

#include <string>

#include "host/result/result.hpp"

namespace fencepost::host {

/// One row per object on a common time axis: a strip of levels over the curve of distances.
std::string alert_timeline(const ResultDocument& document);

/// Every alert record, folded away when there are many.
std::string alert_table(const ResultDocument& document);

}  // namespace fencepost::host
