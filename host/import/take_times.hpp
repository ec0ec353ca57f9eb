// Times of imported frames and poses: the unit is checked, and the gaps.
#pragma once

#include <string>

#include "host/import/take.hpp"

namespace fencepost::host {

/// Call with frames and poses in order. Adds a note where times with poses look like milliseconds.
/// errors: ImportProblem: another unit than seconds, or times that are too far apart
void check_times(Taken& taken, const std::string& source);

}  // namespace fencepost::host
