// The report's tables that are not about alerts or accuracy.
#pragma once

#include <string>

#include "host/result/result.hpp"

namespace fencepost::host {

/// The run in a handful of figures.
std::string headline_figures(const ResultDocument& document);

/// Every object with every model's area, and why a model is silent.
std::string object_rows(const ResultDocument& document);

/// What was read, what was not used and why; digest and profile.
std::string record_counts(const ResultDocument& document);

}  // namespace fencepost::host
