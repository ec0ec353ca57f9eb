// A run as an MCAP file for Foxglove, Lichtblick, RViz and rosbag2.
#pragma once

#include <string>

#include "host/export/mcap/encoding.hpp"
#include "host/export/run.hpp"

namespace fencepost::host::exports {

/// The bytes of the file: poses, detections, objects and alerts in order of time, the log itself as an attachment.
/// `start`: s since 1970 at the run's time 0.
std::string mcap_of(const Run& run, const Encoding& encoding, double start);

}  // namespace fencepost::host::exports
