#include "host/doctor/ports/usb_guess.hpp"

#include <fmt/format.h>

#include "host/devices/catalogue.hpp"

namespace fencepost::host::doctor {
namespace {

struct Known {
  std::uint16_t vendor;
  std::uint16_t product;  ///< 0: any
  UsbKind kind;
  const char* name;
};

// From the list of USB ids (usb.ids) and the boards' own documents.
constexpr Known kKnown[] = {
    {0x10C4, 0xEA60, UsbKind::kAdapter, "CP210x serial adapter"},
    {0x1A86, 0x7523, UsbKind::kAdapter, "CH340 serial adapter"},
    {0x1A86, 0x55D4, UsbKind::kAdapter, "CH9102 serial adapter"},
    {0x0403, 0x0000, UsbKind::kAdapter, "FTDI serial adapter"},
    {0x067B, 0x2303, UsbKind::kAdapter, "PL2303 serial adapter"},
    {0x067B, 0x23A3, UsbKind::kAdapter, "PL2303GC serial adapter"},
    {0x04D8, 0x00DD, UsbKind::kAdapter, "MCP2221 serial adapter"},
    {0x0D28, 0x0204, UsbKind::kBoard, "micro:bit, or another board with DAPLink"},
    {0x2E8A, 0x0000, UsbKind::kBoard, "board with an RP2040 or RP2350"},
    {0x0483, 0x5740, UsbKind::kBoard, "STM32 with a serial port of its own"},
    {0xF055, 0x0000, UsbKind::kBoard, "pyboard under MicroPython"},
    {0x239A, 0x0000, UsbKind::kBoard, "Adafruit board"},
    {0x2341, 0x0000, UsbKind::kBoard, "Arduino"},
    {0x2886, 0x0000, UsbKind::kBoard, "Seeed board"},
    {0x303A, 0x0000, UsbKind::kBoard, "ESP32"},
};

std::string listed_rows(const std::vector<const devices::Row*>& rows) {
  std::string text;
  for (const devices::Row* row : rows) text += (text.empty() ? "" : " or ") + *row->about;
  std::erase(text, '`');
  return text;
}

}  // namespace

std::vector<const devices::Row*> rows_of(const UsbDevice& device) {
  std::vector<const devices::Row*> rows;
  for (const devices::Row& row : devices::catalogue()) {
    const bool same = row.usb && row.usb->vendor == device.vendor && row.usb->product == device.product;
    if (same && row.live->has_value()) rows.push_back(&row);
  }
  return rows;
}

UsbGuess guess_usb(const UsbDevice& device, const std::string& path) {
  if (const auto rows = rows_of(device); !rows.empty()) {
    const bool camera = *rows.front()->role == devices::Role::kCamera;
    return {UsbKind::kDevice, listed_rows(rows),
            fmt::format("doctor --{} {}:usb", camera ? "camera" : "odometry", *rows.front()->name)};
  }
  for (const Known& known : kKnown) {
    if (known.vendor != device.vendor || (known.product != 0 && known.product != device.product)) continue;
    const bool board = known.kind == UsbKind::kBoard;
    return {known.kind, known.name, board ? fmt::format("record {} -o run.log", path) : "doctor " + path};
  }
  return {UsbKind::kUnknown, "", "doctor " + path};
}

}  // namespace fencepost::host::doctor
