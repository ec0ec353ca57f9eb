// The robot's beliefs as one screen of a terminal: level, map, objects, alerts, links. A pure function.
#pragma once

#include <string>

#include "host/monitor/believed.hpp"
#include "host/monitor/cells.hpp"

namespace fencepost::host::monitor {

struct Caption {
  std::string name;   ///< of the port or log
  std::string state;  ///< such as "x2", "paused", "unplugged"; may be empty
  std::string keys;   ///< the available keys
};

/// Fits any size. From 72 columns on the objects are beside the map, else below it. Parts without room are left out,
/// the level and the nearest alert last.
Cells screen_of(const Believed& believed, const Caption& caption, Size size);

/// "STOP", ...
std::string word_of(record::AlertLevel level);

}  // namespace fencepost::host::monitor
