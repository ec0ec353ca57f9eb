#include "host/devices/emulated.hpp"

#include <linux/can.h>

namespace fencepost::devices {

emulate::EmulatedDevice emulated(const DeviceSpec& spec) {
  const Emulated& row = **spec.row->emulated;
  const bool can = spec.place.kind == PlaceKind::kCan;
  emulate::EmulatedDevice device;
  device.make = [spec](const emulate::Colours& colours) { return (*(*spec.row->emulated)->make)(spec, colours); };
  device.describe = *row.describe;
  device.image = row.image;
  device.asked = row.asked;
  device.baud = spec.number("baud");
  device.unit = can ? sizeof(can_frame) : 1;
  device.host_seen = !can;
  return device;
}

std::string label_of_emulated(const DeviceSpec& spec) {
  const Emulated& row = **spec.row->emulated;
  return row.label.empty() ? spec.kind_name() : row.label;
}

emulate::WheelShape wheels_of(const DeviceSpec& spec) {
  if ((*spec.row->emulated)->wheels.tick <= 0) return {};
  return {spec.real("tick"), spec.real("track")};
}

emulate::OpenedTransport open_transport(const DeviceSpec& spec) {
  switch (spec.place.kind) {
    case PlaceKind::kTty: return emulate::open_pty(spec.place.name);
    case PlaceKind::kTcp: return emulate::open_tcp(spec.place.name);
    case PlaceKind::kCan: return emulate::open_can(spec.place.name);
    case PlaceKind::kI2c:
    case PlaceKind::kSpi:
    case PlaceKind::kUsb:
    case PlaceKind::kNxt:
    case PlaceKind::kVideo:
    case PlaceKind::kFilm:
    case PlaceKind::kNone: break;
  }
  return linux::Problem{"nothing can be emulated there"};
}

}  // namespace fencepost::devices
