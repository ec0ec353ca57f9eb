// The result document as JSON text (the layout is in share/doc/results.md).
#pragma once

#include <string>

#include "host/result/result.hpp"

namespace fencepost::host {

/// One line with a line end. The same document gives the same bytes: fixed key order, lengths to 1e-6 m, times to
/// 1e-4 s, rings closed, outer rings counter-clockwise. What is not a finite number is null.
std::string to_json(const ResultDocument& document);

}  // namespace fencepost::host
