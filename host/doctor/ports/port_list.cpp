#include "host/doctor/ports/port_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>

#include "host/doctor/ports/usb_guess.hpp"

namespace fencepost::host::doctor {
namespace {

namespace fs = std::filesystem;

constexpr int kCanType = 280;  // ARPHRD_CAN

/// The first line; empty where there is none.
std::string first_line(const fs::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  return line;
}

std::uint16_t hexadecimal(const std::string& text) {
  std::uint16_t value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value, 16);
  return value;
}

int number(const std::string& text) {
  int value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

std::optional<UsbDevice> usb_at(const fs::path& folder) {
  std::error_code none;
  if (!fs::exists(folder / "idVendor", none)) return std::nullopt;
  return UsbDevice{hexadecimal(first_line(folder / "idVendor")), hexadecimal(first_line(folder / "idProduct")),
                   first_line(folder / "manufacturer"), first_line(folder / "product"), first_line(folder / "serial")};
}

/// A port is below its USB device, some folders deep.
std::optional<UsbDevice> usb_above(const fs::path& device) {
  constexpr int kDeepest = 6;
  std::error_code none;
  fs::path folder = fs::canonical(device, none);
  if (none) return std::nullopt;
  for (int i = 0; i < kDeepest && folder.has_relative_path(); ++i, folder = folder.parent_path()) {
    if (const auto usb = usb_at(folder)) return usb;
  }
  return std::nullopt;
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none)) names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  return names;
}

// A kernel has names for serial ports of a PC that has none: their type is 0.
bool is_there(const fs::path& tty) {
  std::error_code none;
  if (!fs::exists(tty / "device", none)) return false;
  return !tty.filename().string().starts_with("ttyS") || first_line(tty / "type") != "0";
}

std::string lasting_name(const Roots& roots, const fs::path& node) {
  std::error_code none;
  const fs::path folder = roots.dev / "serial" / "by-id";
  for (const std::string& name : names_in(folder)) {
    if (fs::equivalent(folder / name, node, none)) return (folder / name).string();
  }
  return {};
}

void list_ttys(const Roots& roots, std::vector<PortEntry>& ports) {
  const fs::path folder = roots.sys / "class" / "tty";
  for (const std::string& name : names_in(folder)) {
    if (!is_there(folder / name)) continue;
    PortEntry port{PlaceKind::kTty, (roots.dev / name).string(), {}, usb_above(folder / name / "device"), {}};
    port.lasting = lasting_name(roots, port.path);
    ports.push_back(std::move(port));
  }
}

void list_usb(const Roots& roots, std::vector<PortEntry>& ports) {
  const fs::path folder = roots.sys / "bus" / "usb" / "devices";
  for (const std::string& name : names_in(folder)) {
    const auto usb = usb_at(folder / name);
    if (!usb || rows_of(*usb).empty()) continue;
    const fs::path node = roots.dev / "bus" / "usb" /
                          fmt::format("{:03}", number(first_line(folder / name / "busnum"))) /
                          fmt::format("{:03}", number(first_line(folder / name / "devnum")));
    ports.push_back({PlaceKind::kUsb, node.string(), {}, usb, {}});
  }
}

void list_buses(const Roots& roots, const char* folder, PlaceKind kind, std::vector<PortEntry>& ports) {
  for (const std::string& name : names_in(roots.sys / "class" / folder)) {
    ports.push_back(
        {kind, (roots.dev / name).string(), {}, {}, first_line(roots.sys / "class" / folder / name / "name")});
  }
}

void list_can(const Roots& roots, std::vector<PortEntry>& ports) {
  const fs::path folder = roots.sys / "class" / "net";
  for (const std::string& name : names_in(folder)) {
    if (number(first_line(folder / name / "type")) != kCanType) continue;
    ports.push_back({PlaceKind::kCan, name, {}, {}, first_line(folder / name / "operstate")});
  }
}

}  // namespace

std::vector<PortEntry> list_ports(const Roots& roots) {
  std::vector<PortEntry> ports;
  list_ttys(roots, ports);
  list_usb(roots, ports);
  list_buses(roots, "i2c-dev", PlaceKind::kI2c, ports);
  list_buses(roots, "spidev", PlaceKind::kSpi, ports);
  list_can(roots, ports);
  return ports;
}

std::optional<UsbDevice> usb_of_tty(const Roots& roots, const std::string& path) {
  std::error_code none;
  const fs::path node = fs::canonical(path, none);
  if (none) return std::nullopt;
  return usb_above(roots.sys / "class" / "tty" / node.filename() / "device");
}

std::string usb_id(const UsbDevice& device) { return fmt::format("{:04x}:{:04x}", device.vendor, device.product); }

}  // namespace fencepost::host::doctor
