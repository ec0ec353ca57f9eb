// An evaluation as JSON text (the layout is in share/doc/evaluate.md).
#pragma once

#include <span>
#include <string>
#include <vector>

#include "host/evaluate/evaluation.hpp"

namespace fencepost::host {

/// One line with a line end. The same measures give the same bytes: fixed key order, shares and lengths to 1e-6.
/// `unjudged` is there if there are any.
std::string to_json(std::span<const Evaluation> evaluations, const Summary& summary,
                    const std::vector<std::uint32_t>& views, std::span<const UnjudgedLog> unjudged = {});

}  // namespace fencepost::host
