// The report's tables that are not about alerts or accuracy.
#pragma once

#include <string>

#include "host/result/result.hpp"

namespace fencepost::host {

/// The run in a handful of figures.
std::string headline_figures(const ResultDocument& document);

/// Every object with every model's area, or the reason why a model has none.
std::string object_rows(const ResultDocument& document);

/// Counts of records read, not used and why; digest and profile.
std::string record_counts(const ResultDocument& document);

}  // namespace fencepost::host
