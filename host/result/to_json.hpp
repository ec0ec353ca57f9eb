// The result document as JSON text (the layout is in share/doc/results.md).
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "host/result/result.hpp"

namespace fencepost::host {

/// One line with a line end. The same document gives the same bytes: fixed key order, lengths to 1e-6 m, times to
/// 1e-4 s, rings closed, outer rings counter-clockwise. What is not a finite number is null.
std::string to_json(const ResultDocument& document);

/// Visits alerts in order.
using EachAlert = std::function<void(const std::function<void(const record::AlertReport&)>&)>;
/// The same bytes in portions, with alerts that are not in the document's memory.
void write_json(const ResultDocument& document, const EachAlert& alerts,
                const std::function<void(std::string_view)>& write);

}  // namespace fencepost::host
