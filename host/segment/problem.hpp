// Errors of images, poses and calibrations.
#pragma once

#include "host/import/import.hpp"

namespace fencepost::host {

/// Thrown inside host/segment, turned into the result's error by `segment`.
using SegmentProblem = ImportError;

}  // namespace fencepost::host
