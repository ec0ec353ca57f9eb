// Status of a recording: one line while it runs, a summary when it has ended.
#pragma once

#include <string>
#include <vector>

#include "host/recorder/tally.hpp"

namespace fencepost::host {

/// Time, rates, frames; then only anomalies: losses, rejected lines, links that are not ok, silence.
/// The first `width` characters of it, cut between two items.
std::string status_line(const Tally& tally, base::Time now, bool connected, std::size_t width);

/// One item a line.
std::vector<std::string> summary(const Tally& tally, base::Time now);

/// 512 B, 9.3 kB, 1.2 MB
std::string in_bytes(double bytes);

}  // namespace fencepost::host
