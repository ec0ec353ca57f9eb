#include "host/doctor/ports/access.hpp"

#include <fmt/format.h>
#include <grp.h>
#include <sys/stat.h>

namespace fencepost::host::doctor {
namespace {

constexpr mode_t kReadWrite = 06;

bool allows(mode_t three_bits) { return (three_bits & kReadWrite) == kReadWrite; }
bool group_may(const Node& node) { return allows(node.mode >> 3U); }

std::string udev_rule(const Node& node, const UsbDevice& usb) {
  const bool raw = node.path.find("/bus/usb/") != std::string::npos;
  return fmt::format(
      "echo 'SUBSYSTEM==\"{}\", {}{{idVendor}}==\"{:04x}\", {}{{idProduct}}==\"{:04x}\", MODE=\"0666\"' | sudo tee "
      "/etc/udev/rules.d/70-fencepost.rules && sudo udevadm control --reload && sudo udevadm trigger",
      raw ? "usb" : "tty", raw ? "ATTR" : "ATTRS", usb.vendor, raw ? "ATTR" : "ATTRS", usb.product);
}

}  // namespace

std::optional<Node> node_at(const std::string& path) {
  struct stat about {};
  if (::stat(path.c_str(), &about) != 0) return std::nullopt;
  Node node{path, about.st_uid, about.st_gid, std::to_string(about.st_gid), about.st_mode};
  if (const group* entry = ::getgrgid(about.st_gid)) node.group_name = entry->gr_name;
  return node;
}

bool may_open(const Node& node, const Identity& who) {
  if (who.user == 0) return true;
  if (who.user == node.owner) return allows(node.mode >> 6U);
  if (who.groups.contains(node.group)) return group_may(node);
  return allows(node.mode);
}

std::string permission_remedy(const Node& node, const Identity& who, const std::optional<UsbDevice>& usb, bool udev) {
  const bool by_group = group_may(node) && node.group != 0;
  if (by_group && who.registered.contains(node.group)) {
    return fmt::format("you are in its group {0}, but this session began before: log out and in, or type 'newgrp {0}'",
                       node.group_name);
  }
  if (by_group) {
    return fmt::format("type 'sudo usermod -aG {} {}', then log out and in", node.group_name,
                       who.name.empty() ? "$(id -un)" : who.name);
  }
  if (udev && usb) return fmt::format("type \"{}\", then plug it in again", udev_rule(node, *usb));
  return fmt::format("type 'sudo chmod a+rw {}'; it lasts until it is plugged in again", node.path);
}

}  // namespace fencepost::host::doctor
