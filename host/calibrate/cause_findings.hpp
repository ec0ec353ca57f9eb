// Names the causes of wrong distances, and says how each is mended.
#pragma once

#include <string>
#include <vector>

#include "firmware/record/records.hpp"
#include "host/calibrate/causes.hpp"
#include "host/doctor/finding.hpp"

namespace fencepost::host {

/// `log`: its name on a command line.
doctor::Findings findings_of_causes(const std::vector<Cause>& causes, const std::vector<record::Signature>& signatures,
                                    const std::string& log);

}  // namespace fencepost::host
