// An evaluation as text for a terminal.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "host/evaluate/evaluation.hpp"

namespace fencepost::host {

/// At most 80 columns for names of ordinary size. One log: each object, a row a model and a column a number of views.
/// Several: means with their standard errors, a row a model and number of views. Then the missed objects by log, and
/// the logs that could not be judged.
std::string evaluation_text(std::span<const Evaluation> evaluations, const Summary& summary,
                            const std::vector<std::uint32_t>& views, std::span<const UnjudgedLog> unjudged = {});

}  // namespace fencepost::host
