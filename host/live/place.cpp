#include "host/live/place.hpp"

#include "host/text/device_word.hpp"

namespace fencepost::host {

using enum PlaceKind;

std::optional<Place> parse_tcp(std::string_view text, std::uint32_t least) {
  constexpr std::string_view kStart = "tcp:";
  if (!text.starts_with(kStart)) return std::nullopt;
  text.remove_prefix(kStart.size());
  const std::size_t colon = text.rfind(':');
  if (colon == std::string_view::npos) return std::nullopt;
  std::string_view host = text.substr(0, colon);
  if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
  const std::optional<std::uint32_t> port = whole_number(text.substr(colon + 1));
  if (host.empty() || !port || *port < least || *port > 0xFFFF) return std::nullopt;
  return Place{kTcp, std::string(host), static_cast<std::uint16_t>(*port)};
}

namespace {

bool is_film(std::string_view text) {
  for (const std::string_view end : {".y4m", ".mjpeg", ".mjpg", ".jpeg", ".jpg"}) {
    if (text.ends_with(end)) return true;
  }
  return false;
}

}  // namespace

bool is_com_port(std::string_view text) {
  constexpr std::string_view kPrefix = "\\\\.\\";
  if (text.starts_with(kPrefix)) text.remove_prefix(kPrefix.size());
  if (!text.starts_with("COM") && !text.starts_with("com")) return false;
  text.remove_prefix(3);
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

Place place_in(std::string_view text, bool can) {
  if (const std::optional<Place> tcp = parse_tcp(text)) return *tcp;
  Place place;
  place.name = text;
  place.kind = text == "usb"                         ? kUsb
               : text == "nxt"                       ? kNxt
               : text.starts_with("/dev/i2c-")       ? kI2c
               : text.starts_with("/dev/spidev")     ? kSpi
               : text.starts_with("/dev/video")      ? kVideo
               : is_film(text)                       ? kFilm
               : text.find('/') != std::string::npos ? kTty
               : is_com_port(text)                   ? kTty
               : can && !text.starts_with("tcp:")    ? kCan
                                                     : kNone;
  return place;
}

std::string_view place_pattern(PlaceKind kind) {
  switch (kind) {
    case kTty: return "/dev/tty...";
    case kTcp: return "tcp:HOST:PORT";
    case kI2c: return "/dev/i2c-N";
    case kSpi: return "/dev/spidevN.M";
    case kUsb: return "usb";
    case kNxt: return "nxt";
    case kCan: return "a CAN interface";
    case kVideo: return "/dev/videoN";
    case kFilm: return "FILM.y4m";
    case kNone: break;
  }
  return "";
}

std::string_view silent_remedy(PlaceKind kind) {
  switch (kind) {
    case kTty: return "check its power, the wires (TX to RX) and the baud";
    case kI2c: return "check its power, the wires and the address; 'i2cdetect -y N' lists who answers";
    case kSpi: return "check its power and the wires, and that the camera is set to SPI";
    case kCan: return "check power, termination and bit rate; 'candump' shows what comes";
    case kVideo: return "check its cable, and that no other program has it";
    case kNxt: return "check the cable between camera and brick, and port=";
    case kTcp:
    case kUsb:
    case kFilm:
    case kNone: break;
  }
  return "check that it is switched on";
}

}  // namespace fencepost::host
