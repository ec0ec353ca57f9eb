// Reads the output of `candump -l`, `candump -L` and `candump -t a` through the mapping of a robot file.
#pragma once

#include <string>
#include <string_view>

#include "drivers/can_wheels/wheels.hpp"
#include "host/import/take.hpp"

namespace fencepost::host {

/// "(1436509052.249713) can0 123#DEADBEEF", or with the columns of a terminal. Frames of wheels become poses.
/// errors: ImportProblem
std::vector<TimedPose> poses_of_candump(std::string_view text, const std::string& file,
                                        const can_wheels::Mapping& mapping, Taken& counts);

/// `blobs`: a table as import_csv takes it, whose times are of the same clock.
ImportResult import_candump(std::string_view text, const std::string& file, const can_wheels::Mapping& mapping,
                            Taken blobs, const TakeSettings& settings);

}  // namespace fencepost::host
