// Whether this user may open a port, and if not, the remedy on this very system.
#pragma once

#include <optional>
#include <string>

#include "host/doctor/ports/port_list.hpp"
#include "host/doctor/ports/surroundings.hpp"

namespace fencepost::host::doctor {

/// A device node's owner and permissions.
struct Node {
  std::string path;
  uid_t owner = 0;
  gid_t group = 0;
  std::string group_name;
  mode_t mode = 0;
};

/// Nothing where there is none.
std::optional<Node> node_at(const std::string& path);

/// For reading and writing; the system's own rules, of owner, group and others.
bool may_open(const Node& node, const Identity& who);

/// Commands for the user to type. `usb`: the device behind the node, for a udev rule; `udev`: it runs here.
std::string permission_remedy(const Node& node, const Identity& who, const std::optional<UsbDevice>& usb, bool udev);

}  // namespace fencepost::host::doctor
