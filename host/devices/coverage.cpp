#include "host/devices/coverage.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "firmware/config/devices.hpp"
#include "host/devices/catalogue.hpp"

namespace fencepost::devices {
namespace {

using enum PlaceKind;

constexpr const char* kNothing = "none";

/// TCP is a serial line over a network: it has no line of its own.
constexpr PlaceKind kLinks[] = {kTty, kI2c, kSpi, kUsb, kNxt, kCan, kVideo, kFilm};

std::string_view link_name(PlaceKind link) {
  switch (link) {
    case kTty:
    case kTcp: return "serial";
    case kI2c: return "I2C";
    case kSpi: return "SPI";
    case kUsb: return "USB";
    case kNxt: return "NXT brick";
    case kCan: return "CAN";
    case kVideo: return "camera of the kernel";
    case kFilm: return "film";
    case kNone: break;
  }
  return "";
}

Tried tried_on(const Row& row, PlaceKind link) {
  const auto found = std::ranges::find(row.tried, link, &Tried::link);
  return found == row.tried.end() ? Tried{link} : *found;
}

/// The row of `emulate` that plays `row` there; behind a brick it is one of its own.
bool is_played(const Row& row, PlaceKind link) {
  if (link != kNxt) return row.emulated->has_value() && has((*row.emulated)->places, link);
  return std::ranges::any_of(catalogue(), [&](const Row& other) { return *other.name == *row.name + ":nxt"; });
}

std::string emulator(const Row& row, PlaceKind link, const Tried& tried) {
  if (is_played(row, link)) return "emulate";
  return tried.bench.empty() && tried.guest.empty() ? kNothing : "in tests";
}

std::string guest(PlaceKind link, const Tried& tried) {
  if (!tried.guest.empty()) return "yes";
  return link == kTty ? "" : kNothing;
}

std::string others(const Row& row, PlaceKind link, const Tried& tried) {
  if (!tried.others.empty()) return tried.others;
  const bool anything = is_played(row, link) || !tried.bench.empty() || !tried.guest.empty();
  return anything ? "emulator only" : "not tried at all";
}

}  // namespace

std::string coverage_table() {
  std::string text = "device,link,emulator,guest kernel,other people's software\n";
  for (const Row& row : catalogue()) {
    if (!row.live->has_value()) continue;
    for (const PlaceKind link : kLinks) {
      if (!has((*row.live)->places, link)) continue;
      const Tried tried = tried_on(row, link);
      text += fmt::format("{},{},{},{},\"{}\"\n", *row.name, link_name(link), emulator(row, link, tried),
                          guest(link, tried), others(row, link, tried));
    }
  }
  for (const config::DeviceInfo& odometry : config::kOdometries) {
    if (odometry.port != config::Port::kPins) continue;
    text += fmt::format("{},pins,boards' emulators,,\"emulator only\"\n", odometry.name);
  }
  return text;
}

}  // namespace fencepost::devices
