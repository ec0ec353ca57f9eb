// How far each device is covered on each of its links: tests/results/devices.csv, for reviewers.
#pragma once

#include <string>

namespace fencepost::devices {

/// A line per device and link, with its heading: driver, emulator, guest kernel, board, other people's software.
std::string coverage_table();

}  // namespace fencepost::devices
