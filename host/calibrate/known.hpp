// Lengths that the user measured: widths of blocks, distances between them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/calibrate/calibrate.hpp"
#include "host/calibrate/start.hpp"

namespace fencepost::host {

/// The signature's name; "sig 7" where the log has none.
std::string signature_name(const std::vector<record::Signature>& signatures, std::uint8_t signature);

/// Adds the known lengths to the problem. Answers what is wrong with one of them, or nothing.
std::optional<std::string> add_known(const CalibrateOptions& options, const std::vector<record::Signature>& signatures,
                                     StartedProblem& started);

}  // namespace fencepost::host
